#include "app/render/renderer.h"

#include "app/render/raster.h"
#include "app/scene/plan_hash.h"

#include <GLES2/gl2ext.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <string_view>

namespace frustumscreen::render {

namespace {

bool driver_has(std::string_view extension) {
    GLint count = 0;
    glGetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint k = 0; k < count; ++k) {
        if (extension == reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, static_cast<GLuint>(k)))) {
            return true;
        }
    }
    return false;
}

void clear(GLbitfield what) {
    glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
    glClearDepthf(1.0F);
    glClearStencil(0);
    glStencilMask(0xFF);
    glDepthMask(GL_TRUE);
    glClear(what);
}

/// From an eye's picture to the display's.
PixelRectangle in_display(PixelRectangle part, const scene::FramePlan& plan) {
    part.x += plan.picture.viewport.x;
    part.y += plan.picture.viewport.y;
    return part;
}

} // namespace

Result<Renderer> Renderer::create(int width, int height, const scene::RenderNeeds& needs) {
    for (const std::string_view extension : {"GL_EXT_texture_sRGB_decode", "GL_EXT_sRGB_write_control"}) {
        if (!driver_has(extension)) {
            return fail(ErrorKind::BadConfiguration, "render.no_extension",
                        "render: this OpenGL ES driver lacks {}; Mesa's drivers have it", extension);
        }
    }
    Renderer renderer(width, height);
    TRY_VOID(renderer.prepare(needs));
    return renderer;
}

Result<void> Renderer::prepare(const scene::RenderNeeds& needs) {
    const scene::RenderNeeds all = scene::united(needs_, needs);
    TRY_VOID(shaders_.prepare(scene::shaders_of(all), all.bent_by));
    TRY_VOID(raster_pass_.prepare(all, width_, height_));
    if (!all.torches.empty()) {
        TRY_VOID((torches_ ? *torches_ : torches_.emplace()).prepare(all));
    }
    if (all.samples > 1 && (all.samples != needs_.samples || all.outline != needs_.outline)) {
        TRY(sample_grid_, SampleGrid::create(all.outline.value_or(PixelSize{width_, height_}), all.samples));
    }
    needs_ = all;
    return {};
}

std::uint64_t Renderer::bytes() const {
    return store_.bytes() + raster_pass_.bytes() + (sample_grid_ ? sample_grid_->bytes() : 0) +
           (torches_ ? torches_->bytes() : 0);
}

bool Renderer::Picture::lies(const OnTable& draw) const {
    return std::any_of(on_table.begin(), on_table.begin() + static_cast<std::ptrdiff_t>(count),
                       [&](const OnTable& own) { return own.hash == draw.hash; });
}

void Renderer::Picture::add_changes(const Picture& other, PixelRectangle& changes) const {
    for (std::size_t k = 0; k < count; ++k) {
        changes = other.lies(on_table[k]) ? changes : united(changes, on_table[k].bounds);
    }
}

Renderer::Picture Renderer::picture_of(const scene::FramePlan& plan) {
    Picture picture;
    picture.hash = plan.hash;
    picture.prop_hash = plan.prop_hash;
    picture.prop_bounds = scene::bounds_in_prop(plan);
    for (const scene::Draw& draw : plan.draws) {
        if (draw.face == scene::Draw::on_table && picture.count < picture.on_table.size()) {
            picture.on_table[picture.count++] = {scene::hash_of(draw), draw.bounds};
        }
    }
    for (std::size_t k = 0; k < plan.window_count && picture.count < picture.on_table.size(); ++k) {
        picture.on_table[picture.count++] = {plan.windows[k].hash, scene::bounds_in_prop(plan.windows[k])};
    }
    return picture;
}

Renderer::Repaint Renderer::to_redraw(const scene::FramePlan& plan, std::size_t eye, const Picture& picture,
                                      const RenderTarget& target, Redraw redraw) const {
    const auto age = static_cast<std::size_t>(std::max(target.buffer_age, 0));
    if (redraw == Redraw::Everything || age == 0 || age > pictures_) {
        return {.part = {0, 0, plan.projector.width, plan.projector.height}, .prop = true, .whole = true};
    }
    const Picture& held = history_[age - 1][eye];
    Repaint repaint{.part = {}, .prop = held.prop_hash != picture.prop_hash};
    if (held.hash == picture.hash) {
        return {.part = {}, .prop = false}; // the buffer already holds this picture
    }
    held.add_changes(picture, repaint.part);
    picture.add_changes(held, repaint.part);
    repaint.part = repaint.prop ? united(repaint.part, held.prop_bounds) : repaint.part;
    include_touched(std::span(&plan, 1), std::span(&picture, 1), repaint);
    return repaint;
}

void Renderer::share_clears(std::span<const scene::FramePlan> plans, const EyePictures& pictures,
                            std::array<Repaint, max_eyes>& repaints) const {
    const bool overlaid = plans.size() > 1 && plans[0].picture.viewport == plans[1].picture.viewport;
    if (overlaid && !repaints[0].whole) {
        Repaint both{.part = united(repaints[0].part, repaints[1].part),
                     .prop = repaints[0].prop || repaints[1].prop};
        include_touched(plans, pictures, both);
        repaints = {both, both};
    }
    for (std::size_t eye = 0; eye < plans.size(); ++eye) {
        repaints[eye].clear = in_display(repaints[eye].part, plans[eye]);
    }
    if (plans.size() > 1 && (overlaid || repaints[0].whole)) {
        repaints[0].clear = overlaid ? repaints[0].clear : PixelRectangle{0, 0, width_, height_};
        repaints[1].clear = {};
    }
}

bool Renderer::shows(std::span<const scene::FramePlan> plans) const {
    bool same = pictures_ > 0;
    for (std::size_t eye = 0; eye < plans.size(); ++eye) {
        same = same && history_[0][eye].hash == plans[eye].hash;
    }
    return same;
}

DrawResult Renderer::draw(std::span<const scene::FramePlan> plans, const RenderTarget& target,
                          Redraw redraw) {
    assert(!plans.empty() && plans.size() <= max_eyes);
    if (redraw == Redraw::Changes && target.buffer_age > 0 && shows(plans)) {
        return {};
    }
    DrawResult result{.drawn = true, .redrawn = {}, .lit = {}, .draw_calls = 0};
    EyePictures pictures;
    std::array<Repaint, max_eyes> repaints;
    for (std::size_t eye = 0; eye < plans.size(); ++eye) {
        pictures[eye] = picture_of(plans[eye]);
        repaints[eye] = to_redraw(plans[eye], eye, pictures[eye], target, redraw);
    }
    share_clears(plans, pictures, repaints);
    for (std::size_t eye = 0; eye < plans.size(); ++eye) {
        const scene::FramePlan& plan = plans[eye];
        const Repaint& repaint = repaints[eye];
        result.lit = united(result.lit, in_display(scene::lit_bounds(plan), plan));
        if (!repaint.part.empty()) {
            result.redrawn = united(result.redrawn, in_display(repaint.part, plan));
            paint(plan, target, repaint, result);
        }
    }
    std::move_backward(history_.begin(), history_.end() - 1, history_.end());
    history_[0] = pictures;
    pictures_ = std::min(pictures_ + 1, history_.size());
    return result;
}

int Renderer::see_torches(const scene::FramePlan& plan) {
    raster_pass_.find_lit_parts(plan);
    return torches_->see(plan, store_, shaders_, raster_pass_);
}

int Renderer::light_layers(const Lit& lit) {
    return faces_.light_layers(lit) + raster_pass_.light_layers_in_depth(lit);
}

/// The larger picture comes first, so that a tiling GPU visits the display's framebuffer once. Codes are
/// written unchanged throughout; passes that compute in linear light (captions, averages) enable the encoding
/// themselves.
void Renderer::paint(const scene::FramePlan& plan, const RenderTarget& target, const Repaint& repaint,
                     DrawResult& result) {
    const int samples = plan.samples > 0 ? plan.samples : needs_.samples;
    const Raster raster =
        sample_grid_ && !plan.faces.empty() && repaint.prop
            ? sample_grid_->raster(plan.lit.picture(), plan.lit.bounds(), plan.prop_bounds, samples)
            : Raster{};
    const bool smooth = raster.fragments != glm::ivec2(1);
    const bool surfaces = FacePass::draws(plan); // of the GPU, and what it rasterizes among them
    const bool meshes = repaint.prop && !smooth && surfaces;
    const glm::ivec2 viewport(plan.picture.viewport.x, plan.picture.viewport.y);
    const Raster direct{.fragments = {1, 1}, .corner = -viewport};
    std::span<const TorchPicture> torches;
    if (repaint.prop) {
        raster_pass_.paint(plan, store_);
        if (torches_) {
            result.draw_calls += see_torches(plan);
            torches = torches_->pictures();
        }
    }
    glDisable(GL_FRAMEBUFFER_SRGB_EXT);
    if (smooth) {
        sample_grid_->begin(plan.lit, raster, shaders_);
        if (!torches.empty() && surfaces) { // they ask each pixel of their bounds for its depth
            sample_grid_->clear_depth(TorchPass::lit_by(plan), raster);
        }
        result.draw_calls += table_.draw(plan, plan.lit.bounds(), store_, shaders_, raster);
        result.draw_calls += faces_.draw(plan, store_, shaders_, raster);
        result.draw_calls += raster_pass_.show_in_depth(plan, shaders_, raster);
        if (!torches.empty()) {
            result.draw_calls += light_layers({plan, store_, shaders_, raster, torches});
        }
    }
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    set_viewport({plan.projector.width, plan.projector.height}, direct);
    glEnable(GL_SCISSOR_TEST);
    set_channels(glm::bvec3(true));
    if (!repaint.clear.empty()) {
        set_scissor(repaint.clear);
        clear(GL_COLOR_BUFFER_BIT | (meshes ? GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT : 0U));
    } else if (meshes) {
        set_scissor(scene::bounds_in_prop(plan), direct);
        clear(GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    }
    glDisable(GL_SCISSOR_TEST);
    set_channels(plan.picture.channels);
    result.draw_calls += table_.draw(plan, repaint.part, store_, shaders_, direct);
    if (smooth) {
        glEnable(GL_FRAMEBUFFER_SRGB_EXT);
        sample_grid_->average(plan.lit, raster, viewport, shaders_);
        glDisable(GL_FRAMEBUFFER_SRGB_EXT);
        if (!torches.empty() && surfaces) {
            result.draw_calls += torches_->light_samples({plan, store_, shaders_, direct, torches}, raster,
                                                         sample_grid_->depths());
        }
    } else if (meshes) {
        result.draw_calls += faces_.draw(plan, store_, shaders_, direct);
        result.draw_calls += raster_pass_.show_in_depth(plan, shaders_, direct);
        if (!torches.empty()) {
            const Lit lit{plan, store_, shaders_, direct, torches};
            result.draw_calls += light_layers(lit);
            result.draw_calls += torches_->light_pixels(lit);
        }
    }
    if (repaint.prop) {
        result.draw_calls += raster_pass_.show(plan, shaders_);
        if (!torches.empty()) {
            result.draw_calls += raster_pass_.light({plan, store_, shaders_, direct, torches});
        }
    }
    paint_windows(plan, target, repaint.part, result);
    set_channels(glm::bvec3(true));
    glEnable(GL_FRAMEBUFFER_SRGB_EXT);
}

} // namespace frustumscreen::render
