/// Several samples a pixel for a peer, as the exhibit's own levels have them (sample_grid.h): the part of the
/// picture that may show the artifact, drawn larger, then averaged in linear light.
///
/// Threads  the one whose context is current.
/// Errors   at creation only: no memory, or a number of samples that has no grid.
#pragma once

#include "app/bench/peer_gl.h"

namespace frustumscreen {

class PeerSamples {
public:
    /// `samples`: 2, 4, 8 or 16.
    [[nodiscard]] static Result<PeerSamples> create(int width, int height, int samples);

    /// Binds the larger picture; clears the part and cuts all drawing to it.
    void begin(const PixelRect& part) const;
    /// Averages the part into `framebuffer`, which encodes linear light; the rest of that stays as it is.
    void average(const PixelRect& part, GLuint framebuffer) const;

private:
    PeerSamples() = default;

    glm::ivec2 grid_{1, 1}; ///< samples along a pixel's sides
    OffscreenTarget target_;
    GlProgram average_;
    GlVertexArray no_attributes_;
};

} // namespace frustumscreen
