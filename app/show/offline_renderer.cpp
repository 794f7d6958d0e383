#include "app/show/offline_renderer.h"

#include "app/pack/pack_relief.h"
#include "app/render/read_back.h"
#include "app/scene/exposure.h"

#include <fmt/format.h>

#include <chrono>

namespace frustumscreen::show {

namespace {

/// The finest level is chosen where cost does not matter, so it gets the smoothest outlines too.
int samples_of(const OfflineOptions& options, const pack::PackDescription& pack) {
    const int usual = options.technique == "finest" ? render::finest_samples : pack.samples;
    return options.samples > 0 ? options.samples : usual;
}

std::vector<std::uint32_t> levels_to_read(const scene::ScenePlan& plan) {
    return plan.levels.empty() ? std::vector{plan.exposure_level} : plan.levels;
}

/// The settings in the size and layout of the options.
settings::Settings sized(const OfflineSetup& setup) {
    const auto& [checked, options] = setup;
    settings::Settings settings = *checked;
    if (!options.both_eyes) {
        settings.projector.stereo = settings::ProjectorStereo::Off;
    }
    if (options.width > 0 && options.height > 0) {
        settings.projector.pinhole = settings.projector.pinhole.scaled_to(options.width, options.height);
    }
    return settings;
}

/// The scene plan of a pack for the options.
Result<scene::ScenePlan> plan_offline(const OfflineSetup& setup, const pack::PackOutline& pack) {
    const settings::Settings settings = sized(setup);
    const OfflineOptions& options = setup.options;
    scene::SceneRequest request;
    request.technique = options.technique;
    request.live = false;
    request.light = options.light;
    request.samples = samples_of(options, pack.description);
    request.sample_headroom = render::default_samples;
    request.cull_kinds = options.cull_kinds;
    if (!options.views.empty()) {
        request.visibility = scene::visibility_of(settings, options.views);
    }
    return scene::plan_scene(settings, pack, request);
}

} // namespace

Result<OfflineScene>
load_offline(const std::filesystem::path& file,
             const std::function<Result<OfflineSetup>(const pack::PackOutline&)>& setup_of) {
    std::optional<OfflineSetup> setup;
    scene::ScenePlan plan;
    Result<pack::VerifiedPack> pack =
        pack::load_pack(file, [&](const pack::PackOutline& outline) -> Result<std::vector<std::uint32_t>> {
            TRY(OfflineSetup made, setup_of(outline));
            TRY(scene::ScenePlan planned, plan_offline(made, outline));
            setup = std::move(made);
            plan = std::move(planned);
            return levels_to_read(plan);
        });
    TRY_VOID(pack);
    OfflineScene scene{
        .setup = *std::move(setup), .plan = std::move(plan), .pack = *std::move(pack), .relief = nullptr};
    if (!scene.plan.reliefs.empty()) {
        TRY(relief::BlockRelief relief, pack::load_relief(file, scene.plan.reliefs.front()));
        scene.relief = std::make_shared<const relief::BlockRelief>(std::move(relief));
    }
    return scene;
}

OfflineRenderer::OfflineRenderer(const scene::StereoLayout& layout, const scene::ScenePlan& plan)
    : layout_(layout), projector_(plan.projector), table_from_projector_(plan.table_from_projector),
      prop_(plan.prop), light_(plan.light) {}

Result<std::unique_ptr<OfflineRenderer>> OfflineRenderer::create(const OfflineScene& scene) {
    const auto& [setup, plan, pack, relief] = scene;
    const OfflineOptions& options = setup.options;
    std::unique_ptr<OfflineRenderer> made(new OfflineRenderer(scene::stereo_layout(sized(setup)), plan));
    TRY(made->display_,
        display::SurfacelessDisplay::create(made->layout_.display.width, made->layout_.display.height));
    made->technique_ = scene::name_of(plan.quality_levels.front());
    const pack::PackLevel& brightness = pack->levels[plan.exposure_level];
    made->exposure_ = scene::exposure_of(brightness, pack->box_size, pack->textures[brightness.texture],
                                         plan.highlight_code);
    TRY_VOID(scene.relief ? made->take_relief(scene) : made->take_level(scene));
    if (options.hit_points) {
        TRY(made->hit_points_, render::HitPointRenderer::create(*made->renderer_));
    }
    made->placed_.samples = samples_of(options, *pack);
    made->placed_.faces = plan.faces;
    for (std::size_t eye = 0; eye < plan.eyes; ++eye) {
        made->plans_.push_back(scene::make_plan(made->prop_, made->placed_));
    }
    return made;
}

Result<void> OfflineRenderer::take_level(const OfflineScene& scene) {
    const auto& [setup, plan, pack, relief] = scene;
    const std::uint32_t number = plan.quality_levels.front().level;
    const scene::SceneLevel level = scene::scene_level(*pack, number, plan);
    TRY(renderer_, render::Renderer::create(layout_.display.width, layout_.display.height,
                                            scene::needs_of(plan, level)));
    const image::Image8& texture = pack->textures[level.mesh.texture];
    TRY(const scene::Drawable drawable, renderer_->store().upload(level, texture));
    seen_ = plan.seen[number];
    placed_ = {.triangles =
                   std::make_shared<scene::LevelTriangles>(scene::triangles_of(level.mesh, pack->box_size)),
               .box_size = pack->box_size,
               .metres_per_box = plan.metres_per_box,
               .drawable = drawable};
    return {};
}

Result<void> OfflineRenderer::take_relief(const OfflineScene& scene) {
    const auto& [setup, plan, pack, relief] = scene;
    TRY(renderer_, render::Renderer::create(layout_.display.width, layout_.display.height, plan.needs));
    seen_ = plan.seen_reliefs.front();
    const bool on_gpu = plan.quality_levels.front().on_gpu;
    TRY(const scene::Drawable drawable,
        on_gpu ? renderer_->store().upload(relief) : renderer_->store().keep(relief));
    placed_ = scene::placed(*pack, relief, plan.metres_per_box, drawable);
    placed_.on_gpu = on_gpu;
    return {};
}

void OfflineRenderer::draw_once(std::span<const scene::PlanView> views) {
    for (std::size_t eye = 0; eye < plans_.size(); ++eye) {
        scene::plan_frame(prop_, placed_, views[eye], plans_[eye]);
    }
    renderer_->draw(plans_, {display_->framebuffer(), display_->buffer_age()}, render::Redraw::Everything);
    (void)display_->present(MonotonicTime{}); // cannot fail without a screen
}

std::optional<scene::ErrorEstimate> OfflineRenderer::error_of(std::span<const scene::PlanView> views) const {
    std::optional<scene::ErrorEstimate> worst;
    for (std::size_t eye = 0; eye < plans_.size(); ++eye) {
        worst = scene::larger(worst, scene::estimate_error(seen_, prop_, placed_, views[eye], plans_[eye]));
    }
    return worst;
}

OfflinePicture OfflineRenderer::draw(const geometry::RigidTransform& table_from_prop,
                                     std::span<const glm::dvec3> eyes_m) {
    const scene::PlanView view{.projector = projector_,
                               .table_from_projector = table_from_projector_,
                               .table_from_prop = table_from_prop,
                               .eyes_m = {},
                               .light = light_,
                               .brightness = exposure_};
    const std::array<scene::PlanView, 2> of_eyes = scene::views_of(layout_, view, eyes_m);
    const std::span<const scene::PlanView> views = std::span(of_eyes).first(layout_.count);
    if (!warm_) {
        draw_once(views); // the driver compiles its shaders on the first picture
        warm_ = true;
    }
    const auto start = std::chrono::steady_clock::now();
    draw_once(views);
    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
    OfflinePicture picture;
    picture.ms = taken.count();
    picture.error = error_of(views);
    picture.colour =
        render::read_colour(display_->framebuffer(), layout_.display.width, layout_.display.height);
    if (hit_points_) {
        picture.hit_points = hit_points_->draw(plans_.front(), renderer_->store());
    }
    return picture;
}

} // namespace frustumscreen::show
