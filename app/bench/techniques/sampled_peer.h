/// A peer with one or several samples a pixel, which gets what the exhibit's own levels get: only where the artifact may show is
/// depth cleared, and are several samples cleared, drawn larger and averaged in linear light, by the exhibit's own sample grid. Several
/// become more where the exhibit takes more: in slanting views.
///
/// Places   those of one sample at the pixel's centre, as for every technique.
/// Threads  the one whose context is current; the stage must outlive the technique.
/// Errors   a number of samples that has no grid; a picture that the driver cannot hold.
#pragma once

#include "app/bench/techniques/peer_gl.h"
#include "app/render/sample_grid.h"

#include <memory>
#include <string>

namespace frustumscreen {

/// The larger picture; peers may share one, since each draws all of its own.
class PeerSamples {
public:
    /// `samples`: 2, 4, 8 or 16 a pixel.
    [[nodiscard]] static Result<std::shared_ptr<const PeerSamples>> create(const Stage& stage, int samples);

    [[nodiscard]] int count() const { return count_; }
    /// Binds the larger picture, in which the tiles are clear, for codes. As the exhibit's, a picture of so low a density takes more.
    [[nodiscard]] Raster begin(const LitTiles& tiles, double density) const;
    /// Averages the tiles into the framebuffer that is bound.
    void average(const LitTiles& tiles, const Raster& raster) const;

private:
    PeerSamples(int count, const PixelSize& picture, SampleGrid grid, ShaderCache shaders)
        : count_(count), picture_{0, 0, picture.width, picture.height}, grid_(std::move(grid)),
          shaders_(std::move(shaders)) {}
    int count_;
    PixelRectangle picture_;
    SampleGrid grid_;
    ShaderCache shaders_;
};

class SampledPeer : public PeerTechnique {
public:
    void draw(const BenchPose& pose) final;

protected:
    /// `samples`: none for one a pixel. `points`: a float target of the stage's size.
    SampledPeer(const Stage& stage, const std::string& name, std::shared_ptr<const PeerSamples> samples,
                OffscreenTarget points);
    struct Shown {
        const LitTiles& lit;  ///< every pixel that may be
        double density = 1.0; ///< pixel_density
    };
    /// Does what comes before the picture, and says what it will be.
    [[nodiscard]] virtual Shown prepare(const BenchPose& pose, Output output) = 0;
    /// Draws what was prepared into the framebuffer that is bound, whose tiles are clear: black, far, stencil 0.
    virtual void paint(const Raster& raster, Output output) = 0;

private:
    void draw_into(GLuint framebuffer, const BenchPose& pose, Output output) final;

    std::shared_ptr<const PeerSamples> samples_;
};

} // namespace frustumscreen
