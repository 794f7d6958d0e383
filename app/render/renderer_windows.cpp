// The part of the renderer that draws windows. They come after everything else and change only their own pixels.

#include "app/render/renderer.h"

#include <GLES2/gl2ext.h>

namespace frustumscreen::render {

namespace {

/// While it lives, only the pixels that the stencil marks are drawn.
class InWindow {
public:
    InWindow() {
        glEnable(GL_STENCIL_TEST);
        glStencilFunc(GL_NOTEQUAL, 0, 0xFF);
        glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    }
    ~InWindow() { glDisable(GL_STENCIL_TEST); }
    InWindow(const InWindow&) = delete;
    InWindow& operator=(const InWindow&) = delete;
};

void clear_depth_and_stencil(const PixelRectangle& part, const Raster& raster) {
    glEnable(GL_SCISSOR_TEST);
    set_scissor(part, raster);
    glClearDepthf(1.0F);
    glClearStencil(0);
    glStencilMask(0xFF);
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    glDisable(GL_SCISSOR_TEST);
}

} // namespace

void Renderer::include_touched(std::span<const scene::FramePlan> plans, std::span<const Picture> pictures,
                               Repaint& repaint) {
    PixelRectangle prop;
    for (std::size_t k = 0; k < plans.size(); ++k) {
        prop = united(prop, pictures[k].prop_bounds);
    }
    PixelRectangle before;
    do {
        before = repaint.part;
        if (repaint.prop || !intersected(repaint.part, prop).empty()) {
            repaint = {.part = united(repaint.part, prop), .prop = true};
        }
        for (const scene::FramePlan& plan : plans) {
            for (std::size_t k = 0; k < plan.window_count; ++k) {
                const PixelRectangle window = scene::bounds_in_prop(plan.windows[k]);
                if (!intersected(repaint.part, window).empty()) {
                    repaint.part = united(repaint.part, window);
                }
            }
        }
    } while (repaint.part != before);
}

int Renderer::draw_surfaces(const scene::FramePlan& window, const scene::FramePlan& plan,
                            std::span<const TorchPicture> torches, const RenderTarget& target,
                            const Raster& direct) {
    if (!FacePass::draws(window)) {
        faces_.mark(window, shaders_, direct);
        return 0;
    }
    const int samples = window.samples > 0 ? window.samples : needs_.samples;
    const Raster raster = sample_grid_ ? sample_grid_->raster(window.lit.picture(), window.lit.bounds(),
                                                              window.prop_bounds, samples)
                                       : Raster{};
    if (raster.fragments == glm::ivec2(1)) {
        int calls = faces_.draw(window, store_, shaders_, direct) +
                    raster_pass_.show_in_depth(window, shaders_, direct);
        if (!torches.empty()) {
            const Lit lit{window, store_, shaders_, direct, torches};
            calls += light_layers(lit) + torches_->light_pixels(lit);
        }
        return calls;
    }
    sample_grid_->begin(window.lit, raster, shaders_);
    if (!torches.empty()) { // they ask each pixel of their bounds for its depth
        sample_grid_->clear_depth(TorchPass::lit_by(window), raster);
    }
    int calls = table_.draw(plan, window.lit.bounds(), store_, shaders_, raster);
    calls += faces_.draw(window, store_, shaders_, raster);
    calls += raster_pass_.show_in_depth(window, shaders_, raster);
    if (!torches.empty()) {
        calls += light_layers({window, store_, shaders_, raster, torches});
    }
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    set_viewport({plan.projector.width, plan.projector.height}, direct);
    faces_.mark(window, shaders_, direct);
    const InWindow in_window;
    glEnable(GL_FRAMEBUFFER_SRGB_EXT);
    sample_grid_->average(window.lit, raster, -direct.corner, shaders_);
    glDisable(GL_FRAMEBUFFER_SRGB_EXT);
    if (!torches.empty()) {
        calls += torches_->light_samples({window, store_, shaders_, direct, torches}, raster,
                                         sample_grid_->depths());
    }
    return calls;
}

int Renderer::draw_window(const scene::FramePlan& window, const scene::FramePlan& plan,
                          const RenderTarget& target, const Raster& direct) {
    raster_pass_.paint(window, store_, RasterPass::Depth::WhereItMeets, RasterPass::Rectangles::AreDrawn);
    int calls = 0;
    std::span<const TorchPicture> torches;
    if (torches_ && !window.torches.empty()) {
        calls = see_torches(window);
        torches = torches_->pictures();
        glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
        set_viewport({plan.projector.width, plan.projector.height}, direct);
    }
    clear_depth_and_stencil(scene::bounds_in_prop(window), direct);
    calls += draw_surfaces(window, plan, torches, target, direct);
    set_channels(plan.picture.channels);
    const InWindow in_window;
    calls += raster_pass_.show(window, shaders_) + raster_pass_.blend_points(window, shaders_);
    if (!torches.empty()) {
        calls += raster_pass_.light({window, store_, shaders_, direct, torches});
    }
    return calls;
}

void Renderer::paint_windows(const scene::FramePlan& plan, const RenderTarget& target,
                             const PixelRectangle& part, DrawResult& result) {
    const Raster direct{.fragments = {1, 1}, .corner = {-plan.picture.viewport.x, -plan.picture.viewport.y}};
    for (std::size_t k = 0; k < plan.window_count; ++k) {
        if (!intersected(part, scene::bounds_in_prop(plan.windows[k])).empty()) {
            result.draw_calls += draw_window(plan.windows[k], plan, target, direct);
        }
    }
}

} // namespace frustumscreen::render
