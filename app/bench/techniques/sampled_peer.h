/// A peer with one or several samples per pixel, treated like the exhibit's own levels: depth is cleared only
/// where the artifact may show, and several samples are cleared there, drawn larger and averaged in linear
/// light by the exhibit's own sample grid. The number rises where the exhibit's does: in grazing views.
///
/// Places   one sample at the pixel's centre, as for every technique.
/// Threads  the one whose context is current; the kiosk must outlive the technique.
/// Errors   a number of samples without a grid; a picture that the driver cannot hold.
#pragma once

#include "app/bench/techniques/peer_gl.h"
#include "app/render/sample_grid.h"

#include <memory>
#include <string>

namespace frustumscreen::bench {

/// The larger picture; peers may share it, since each draws all of its own.
class PeerSamples {
public:
    /// `samples`: 2, 4, 8 or 16 per pixel.
    [[nodiscard]] static Result<std::shared_ptr<const PeerSamples>> create(const Kiosk& kiosk, int samples);

    [[nodiscard]] int count() const { return count_; }
    /// Binds the larger picture for codes, with cleared tiles. As in the exhibit, a picture of low `density`
    /// gets more samples.
    [[nodiscard]] render::Raster begin(const scene::LitTiles& tiles, double density) const;
    /// Averages the tiles into the bound framebuffer.
    void average(const scene::LitTiles& tiles, const render::Raster& raster) const;

private:
    PeerSamples(int count, const PixelSize& picture, render::SampleGrid grid, render::ShaderCache shaders)
        : count_(count), picture_{.x = 0, .y = 0, .width = picture.width, .height = picture.height},
          grid_(std::move(grid)), shaders_(std::move(shaders)) {}
    int count_;
    PixelRectangle picture_;
    render::SampleGrid grid_;
    render::ShaderCache shaders_;
};

class SampledPeer : public PeerTechnique {
public:
    void draw(const BenchPose& pose) final;

protected:
    /// `samples`: null for one per pixel. `points`: a float target of the kiosk's size.
    SampledPeer(const Kiosk& kiosk, const std::string& name, std::shared_ptr<const PeerSamples> samples,
                OffscreenTarget points);
    struct Shown {
        const scene::LitTiles& lit; ///< every pixel that may be lit
        double density = 1.0;       ///< pixel_density
    };
    /// Prepares the picture and returns its extent.
    [[nodiscard]] virtual Shown prepare(const BenchPose& pose, Output output) = 0;
    /// Draws the prepared picture into the bound framebuffer, whose tiles are clear: black, far, stencil 0.
    virtual void paint(const render::Raster& raster, Output output) = 0;

private:
    void draw_into(GLuint framebuffer, const BenchPose& pose, Output output) final;

    std::shared_ptr<const PeerSamples> samples_;
};

} // namespace frustumscreen::bench
