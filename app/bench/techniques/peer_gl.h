/// The little of OpenGL ES that the bench's peers need: offscreen pictures and the prop's faces.
///
/// Threads  the one whose context is current, which must outlive every object here.
/// Errors   a target that the driver cannot hold is an Internal error.
#pragma once

#include "app/bench/techniques/technique.h"
#include "firmware_host/gl/gl_handle.h"

#include <glm/glm.hpp>

#include <vector>

namespace frustumscreen {

/// An offscreen picture with depth and stencil; the colour is a texture (nearest filter unless changed).
struct OffscreenTarget {
    GlTexture colour;
    GlRenderbuffer depth_stencil;
    GlFramebuffer framebuffer;
    int width = 0;
    int height = 0;
};
[[nodiscard]] Result<OffscreenTarget> make_target(int width, int height, GLenum colour_format);

/// The first three channels of a bound float target; NaN where the fourth is 0.
[[nodiscard]] ImageFloat read_points(const OffscreenTarget& target);
/// What a pose means for the peers' passes.
struct PeerView {
    glm::dmat4 clip_from_prop{1.0};     ///< the projector's; depth row zero
    glm::dvec3 eye_m{0.0};              ///< prop frame
    std::vector<const PropFace*> faces; ///< turned to the eye and lit
};
[[nodiscard]] PeerView peer_view(const Stage& stage, const BenchPose& pose);

/// Four corners of each visible face in one buffer, drawn as fans.
class FaceQuads {
public:
    FaceQuads();
    /// Positions are attribute 0, prop frame.
    void set(const std::vector<const PropFace*>& faces);
    void draw(std::size_t face) const;

private:
    GlVertexArray array_;
    GlBuffer buffer_;
};

} // namespace frustumscreen
