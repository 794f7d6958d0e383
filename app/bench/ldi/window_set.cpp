#include "app/bench/ldi/window_set.h"

#include "app/render/read_back.h"
#include "app/scene/scene_level.h"
#include "assets_baked/bake/level.h"

#include <GLES2/gl2ext.h>

#include <algorithm>
#include <utility>

namespace frustumscreen::bench {

namespace {

/// Shaders for meshes and for reliefs.
scene::RenderNeeds needs_of() {
    return {.samples = 1, .draws = {scene::ShaderKey{}, scene::raster_shader()}, .rasterizes = true};
}

} // namespace

WindowSet::WindowSet(settings::Settings settings, WindowScene scene, int pixels)
    : settings_(std::move(settings)), scene_(std::move(scene)), pixels_(pixels),
      prop_(settings::make_prop(settings_.prop)), screen_(window_screen(pixels)) {
    settings_.projector.pinhole = settings_.projector.pinhole.ideal();
}

Result<std::unique_ptr<WindowSet>> WindowSet::open(settings::Settings settings, WindowScene scene,
                                                   int pixels) {
    std::unique_ptr<WindowSet> made(new WindowSet(std::move(settings), std::move(scene), pixels));
    const geometry::Pinhole& pinhole = made->settings_.projector.pinhole;
    TRY(made->display_, display::SurfacelessDisplay::create(pinhole.width, pinhole.height));
    TRY(made->alone_, render::Renderer::create(pinhole.width, pinhole.height, needs_of()));
    TRY(made->windows_, render::Renderer::create(pixels, pixels, needs_of()));
    TRY(made->target_, make_target(pixels, pixels, GL_SRGB8_ALPHA8));
    TRY(const Uploaded alone, made->upload(*made->alone_, *made->scene_.mesh));
    TRY(const Uploaded behind, made->upload(*made->windows_, *made->scene_.mesh));
    made->in_prop_ = alone.placed;
    constexpr double in_prop_m = 0.11; // the town's ground, in a frustum that narrows
    made->in_prop_.metres_per_box = in_prop_m;
    made->in_prop_.prop_from_placed = glm::dmat4(1.0);
    made->geometry_ = behind.placed;
    made->alone_plan_ = scene::make_plan(made->prop_, made->in_prop_);
    TRY(made->hit_points_, render::HitPointRenderer::create(*made->windows_));
    return made;
}

Result<WindowSet::Uploaded> WindowSet::upload(render::Renderer& renderer,
                                              const bake::SourceMesh& mesh) const {
    bake::ChartedMesh charted;
    charted.atlas_width = charted.atlas_height = 1;
    charted.uv_texels = mesh.uvs;
    for (const glm::dvec3& position : mesh.positions) {
        charted.positions.emplace_back(position / scene_.size_m);
    }
    for (const auto& [a, b, c] : mesh.triangles) {
        charted.indices.insert(charted.indices.end(), {a, b, c});
    }
    pack::Pack pack;
    pack.box_size = scene_.box_size;
    pack.textures = {*mesh.textures.front().image};
    pack.levels = {bake::make_level(charted, scene_.box_size)};
    const scene::SceneLevel whole = scene::whole_level(pack, 0);
    TRY(const scene::Drawable drawable, renderer.store().upload(whole, pack.textures.front()));
    Uploaded uploaded{.placed = scene::placed(pack, 0, scene_.size_m, drawable)};
    uploaded.placed.samples = 1;
    uploaded.placed.prop_from_placed = scene_.window_from_site;
    uploaded.bytes = renderer.store().bytes(drawable) + bytes_of(*uploaded.placed.triangles);
    return uploaded;
}

void WindowSet::draw_alone(const glm::dvec3& eye_m) {
    const glm::dvec3 eye_from_table = eye_m + glm::dvec3(0.0, 0.0, 0.05); // to the town's middle
    scene::plan_frame(prop_, in_prop_,
                      {.projector = settings_.projector.pinhole,
                       .table_from_projector = settings_.projector.table_from_projector,
                       .table_from_prop = {},
                       .eyes_m = {&eye_from_table, 1}},
                      alone_plan_);
    alone_->draw(alone_plan_, {display_->framebuffer(), 0}, render::Redraw::Everything);
}

void WindowSet::draw(std::span<const scene::Part> parts, const glm::dvec3& eye_m, scene::FramePlan& plan) {
    scene::plan_frame(screen_.surface, parts,
                      {.projector = screen_.pinhole,
                       .table_from_projector = screen_.table_from_pinhole,
                       .table_from_prop = {},
                       .eyes_m = {&eye_m, 1}},
                      plan);
    windows_->draw(plan, target(), render::Redraw::Everything);
}

void WindowSet::show(std::span<const glm::u8vec4> codes) {
    glBindTexture(GL_TEXTURE_2D, target_.colour.get());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, pixels_, pixels_, GL_RGBA, GL_UNSIGNED_BYTE, codes.data());
}

image::ImageFloat WindowSet::hit_points(const scene::FramePlan& plan) {
    return hit_points_->draw(plan, windows_->store());
}

image::Image8 WindowSet::read_colour() const {
    return render::read_colour(target_.framebuffer.get(), pixels_, pixels_);
}

image::Image8 WindowSet::read_alone() const {
    return render::read_colour(display_->framebuffer(), display_->width(), display_->height());
}

} // namespace frustumscreen::bench
