#include "app/bench/techniques/sampled_peer.h"

#include "app/scene/pixel_density.h"

#include <GLES2/gl2ext.h>
#include <fmt/format.h>

namespace frustumscreen::bench {

Result<std::shared_ptr<const PeerSamples>> PeerSamples::create(const Kiosk& kiosk, int samples) {
    const PixelSize picture{kiosk.width(), kiosk.height()};
    TRY(render::SampleGrid grid, render::SampleGrid::create(picture, samples));
    render::ShaderCache shaders;
    TRY_VOID(shaders.prepare({{scene::ShaderKey::Pass::TileClear},
                              {scene::ShaderKey::Pass::TileAverage},
                              {scene::ShaderKey::Pass::TileAverageMany}},
                             std::nullopt));
    return std::shared_ptr<const PeerSamples>(
        new PeerSamples(samples, picture, std::move(grid), std::move(shaders)));
}

render::Raster PeerSamples::begin(const scene::LitTiles& tiles, double density) const {
    glDisable(GL_FRAMEBUFFER_SRGB_EXT);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    const render::Raster raster = grid_.raster({picture_.width, picture_.height}, tiles.bounds(), picture_,
                                               scene::samples_at(density, count_));
    grid_.begin(tiles, raster, shaders_);
    return raster;
}

void PeerSamples::average(const scene::LitTiles& tiles, const render::Raster& raster) const {
    glEnable(GL_FRAMEBUFFER_SRGB_EXT);
    grid_.average(tiles, raster, {0, 0}, shaders_);
}

SampledPeer::SampledPeer(const Kiosk& kiosk, const std::string& name,
                         std::shared_ptr<const PeerSamples> samples, OffscreenTarget points)
    : PeerTechnique(kiosk, samples ? fmt::format("{} ({} samples)", name, samples->count()) : name,
                    std::move(points)),
      samples_(std::move(samples)) {}

void SampledPeer::draw(const BenchPose& pose) {
    if (!samples_) {
        draw_into(kiosk_.framebuffer, pose, Output::Colour);
        return;
    }
    const auto [lit, density] = prepare(pose, Output::Colour);
    const render::Raster raster = samples_->begin(lit, density);
    paint(raster, Output::Colour);
    begin_codes(kiosk_.framebuffer, kiosk_.width(), kiosk_.height());
    samples_->average(lit, raster);
}

void SampledPeer::draw_into(GLuint framebuffer, const BenchPose& pose, Output output) {
    const scene::LitTiles& lit = prepare(pose, output).lit;
    begin_codes(framebuffer, kiosk_.width(), kiosk_.height(), output == Output::Point ? 0.0F : 1.0F);
    clear_depth_stencil(lit.bounds());
    paint({}, output);
    end_codes();
}

} // namespace frustumscreen::bench
