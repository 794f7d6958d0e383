#include "app/show/offline_renderer.h"

#include "app/image/light_mips.h"
#include "app/render/read_back.h"
#include "app/scene/cell_plan.h"
#include "app/scene/exposure.h"
#include "app/scene/scene_level.h"
#include "app/scene/torch_plan.h"
#include "app/scene/window_patches.h"
#include "app/scene/window_plan.h"
#include "app/show/patch_view.h"
#include "app/world/player.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <utility>

namespace frustumscreen::show {

namespace {

/// Something to draw: the whole artifact, or one of its cells.
struct Source {
    const scene::ScenePlan& plan;
    const pack::Pack& pack;
    const std::shared_ptr<const relief::BlockRelief>& relief;
    std::optional<std::size_t> cell;
    std::optional<scene::SceneLevel> level = std::nullopt; ///< none: the relief is drawn
};

std::vector<Source> sources_of(const OfflineScene& scene) {
    std::vector<Source> sources;
    if (scene.world) {
        for (const OfflineCell& cell : scene.world->drawn) {
            sources.push_back(
                {.plan = cell.plan, .pack = *cell.pack, .relief = cell.relief, .cell = cell.cell});
        }
    } else {
        sources.push_back(
            {.plan = scene.plan, .pack = *scene.pack, .relief = scene.relief, .cell = std::nullopt});
    }
    for (Source& source : sources) {
        if (!source.relief) {
            source.level =
                scene::scene_level(source.pack, source.plan.quality_levels.front().level, source.plan);
        }
    }
    return sources;
}

scene::RenderNeeds needs_of(const std::vector<Source>& sources, bool moves,
                            const std::optional<OfflineTorch>& torch) {
    scene::RenderNeeds needs;
    for (const Source& source : sources) {
        const scene::RenderNeeds own =
            source.level ? scene::needs_of(source.plan, *source.level) : source.plan.needs;
        needs = scene::united(needs, own);
    }
    needs = moves ? scene::with_cells(std::move(needs)) : std::move(needs);
    return torch ? scene::with_torch(std::move(needs),
                                     torch::parts_of(torch->content.stages, torch->content.blend))
                 : needs;
}

/// In place of a source's own texture or colours; null: none.
struct Look {
    const image::Image8* texture = nullptr;
    const std::vector<glm::u8vec4>* colours = nullptr;
};

Look look_of(const std::optional<OfflineTorch>& look, std::size_t number) {
    if (!look) {
        return {};
    }
    return look->textures[number].texels.empty() ? Look{nullptr, look->colours[number].get()}
                                                 : Look{&look->textures[number], nullptr};
}

std::shared_ptr<const relief::BlockRelief> in_look(const std::shared_ptr<const relief::BlockRelief>& relief,
                                                   const Look& look) {
    if (look.colours == nullptr) {
        return relief;
    }
    auto changed = std::make_shared<relief::BlockRelief>(*relief);
    changed->colours = *look.colours;
    return changed;
}

Result<scene::PlacedLevel> upload(const Source& source, const Look& look, render::GpuStore& store) {
    const scene::ScenePlan& plan = source.plan;
    if (source.relief) {
        const bool on_gpu = plan.quality_levels.front().on_gpu;
        const std::shared_ptr<const relief::BlockRelief> relief = in_look(source.relief, look);
        TRY(const scene::Drawable drawable, on_gpu ? store.upload(relief) : store.keep(relief));
        scene::PlacedLevel placed = scene::placed(source.pack, relief, plan.metres_per_box, drawable);
        placed.on_gpu = on_gpu;
        return placed;
    }
    const pack::PackLevel& mesh = source.level->mesh;
    TRY(const scene::Drawable drawable,
        store.upload(*source.level,
                     look.texture != nullptr ? *look.texture : source.pack.textures[mesh.texture]));
    return scene::PlacedLevel{
        .triangles = std::make_shared<scene::LevelTriangles>(scene::triangles_of(mesh, source.pack.box_size)),
        .box_size = source.pack.box_size,
        .metres_per_box = plan.metres_per_box,
        .drawable = drawable};
}

/// The drawn level, or for a relief the finest one that was read.
scene::SceneLevel level_of(const Source& source) {
    if (source.level) {
        return *source.level;
    }
    std::uint32_t finest = 0;
    for (std::uint32_t k = 0; k < source.pack.levels.size(); ++k) {
        finest = source.pack.levels[k].indices.empty() ? finest : k;
    }
    return scene::whole_level(source.pack, finest);
}

/// "level0"; "level0+relief96".
std::string names_of(const std::vector<Source>& sources) {
    std::string names;
    std::set<std::string> told;
    for (const Source& source : sources) {
        const std::string name = scene::name_of(source.plan.quality_levels.front());
        if (told.insert(name).second) {
            names += (names.empty() ? "" : "+") + name;
        }
    }
    return names;
}

} // namespace

OfflineRenderer::OfflineRenderer(const scene::StereoLayout& layout, const scene::ScenePlan& plan)
    : layout_(layout), projector_(plan.projector), table_from_projector_(plan.table_from_projector),
      prop_(plan.prop), light_(plan.light), metres_per_box_(plan.metres_per_box) {}

OfflineRenderer::~OfflineRenderer() {
    if (display_) {
        static_cast<void>(display_->make_current()); // what is deleted now lives in its context
    }
}

Result<std::unique_ptr<OfflineRenderer>> OfflineRenderer::create(const OfflineScene& scene) {
    const scene::ScenePlan& plan = scene.plan;
    const pack::Pack& pack = *scene.pack;
    std::unique_ptr<OfflineRenderer> made(
        new OfflineRenderer(scene::stereo_layout(sized(scene.setup)), plan));
    TRY(made->display_,
        display::SurfacelessDisplay::create(made->layout_.display.width, made->layout_.display.height));
    const pack::PackLevel& brightness = pack.levels[plan.exposure_level];
    made->exposure_ =
        scene::exposure_of(brightness, pack.box_size, pack.textures[brightness.texture], plan.highlight_code);
    TRY_VOID(made->take(scene));
    if (scene.setup.options.hit_points) {
        TRY(made->hit_points_, render::HitPointRenderer::create(*made->renderer_));
    }
    return made;
}

Result<void> OfflineRenderer::take(const OfflineScene& scene) {
    const std::vector<Source> sources = sources_of(scene);
    const bool patches = scene.setup.options.window_patches;
    scene::RenderNeeds needs = needs_of(sources, scene.world.has_value(), scene.torch);
    needs = patches ? scene::with_points(std::move(needs)) : std::move(needs);
    TRY(renderer_, render::Renderer::create(layout_.display.width, layout_.display.height, needs));
    technique_ = names_of(sources);
    std::size_t indices = 0;
    for (const Source& source : sources) {
        const Look look = look_of(scene.look, parts_.size());
        TRY(scene::PlacedLevel placed, upload(source, look, renderer_->store()));
        placed.samples = samples_of(scene.setup.options, *scene.pack);
        placed.faces = source.plan.faces;
        indices += placed.triangles ? placed.triangles->indices.size() : 0;
        shown_.push_back({source.relief ? source.plan.seen_reliefs.front()
                                        : source.plan.seen[source.plan.quality_levels.front().level],
                          source.cell});
        parts_.push_back({std::move(placed), std::nullopt});
        if (patches && look.colours == nullptr) {
            const scene::SceneLevel level = level_of(source);
            kept_.push_back(
                {level, look.texture != nullptr ? *look.texture : source.pack.textures[level.mesh.texture]});
        }
    }
    if (kept_.size() < parts_.size()) {
        kept_.clear();
    }
    if (scene.world) {
        cells_ = scene.world->cells;
        behaviour_ = scene.world->behaviour;
        held_s_ = scene.world->held_s;
        site_ = scene.world->site;
    }
    for (std::size_t eye = 0; eye < scene.plan.eyes; ++eye) {
        plans_.push_back(scene::make_plan(prop_, indices, parts_.size()));
        if (scene.torch) {
            scene::make_torch_space(plans_.back(), prop_.faces.size(), indices, parts_.size());
        }
        if (scene.setup.options.windows > 0) {
            scene::make_window_space(plans_.back(), scene.setup.options.windows, indices, parts_.size(),
                                     scene.torch.has_value());
        }
    }
    return scene.torch ? take_torch(scene) : Result<void>();
}

void OfflineRenderer::pose_cells(double seconds) {
    if (cells_.empty()) {
        return;
    }
    std::vector<world::CellPose> poses = world::poses_at(cells_, behaviour_, held_s_.value_or(seconds));
    for (world::CellPose& pose : poses) {
        pose.box_from_geometry = site_ ? site_->matrix() * pose.box_from_geometry : pose.box_from_geometry;
    }
    for (std::size_t k = 0; k < parts_.size(); ++k) {
        parts_[k].level.beyond = site_ && *site_ != world::SiteView{};
        scene::set_pose(parts_[k].level, poses[shown_[k].cell.value()], metres_per_box_);
    }
}

std::unique_ptr<PatchJob> OfflineRenderer::patches_of(const Window& window, const glm::dvec3& eye_m) const {
    const PatchView view = patch_view({.view = window.view,
                                       .projector = projector_,
                                       .table_from_projector = table_from_projector_,
                                       .eye_m = eye_m,
                                       .samples = window.parts.front().level.samples});
    const auto make_world = [&](const LevelInWindow& /*shown*/) -> Result<FrozenWorld> {
        FrozenWorld world;
        for (std::size_t k = 0; k < kept_.size(); ++k) {
            const scene::PlacedLevel& level = window.parts[k].level;
            add_level(kept_[k].level, kept_[k].texture, level.box_size, level.prop_from_box(),
                      view.samples_per_m, world);
        }
        return world;
    };
    auto job = std::make_unique<PatchJob>();
    job->begin({.make_world = std::make_shared<const WorldMaker>(make_world),
                .shown = {},
                .radius_m = view.radius_m,
                .view = view.cameras,
                .samples = view.samples,
                .number = windows_.size() + 1});
    while (!job->is_done()) {
        job->step();
    }
    job->update();
    return job;
}

bool OfflineRenderer::pin(const scene::WindowPlace& place, const geometry::RigidTransform& table_from_prop,
                          const glm::dvec3& eye_m, double seconds,
                          std::span<const scene::PlacedTorch> torches) {
    pose_cells(seconds);
    const std::optional<scene::WorldBall> world = scene::ball_around(parts_);
    const std::optional<scene::PinnedView> view = world ? scene::pin_view({.table_from_prop = table_from_prop,
                                                                           .prop_middle = prop_.middle,
                                                                           .eye_m = eye_m,
                                                                           .world = *world,
                                                                           .place = place})
                                                        : std::nullopt;
    if (!view) {
        return false;
    }
    auto window = std::make_unique<Window>(Window{*view, {}, nullptr});
    scene::move_behind(view->window_from_prop, parts_, window->parts);
    for (scene::PlacedTorch torch : torches) {
        torch.table_from_torch = table_from_prop.inverse() * torch.table_from_torch;
        window->torches.push_back(scene::moved_behind(*view, view->table_from_window, torch));
    }
    if (!kept_.empty()) {
        window->patches = patches_of(*window, eye_m);
    }
    placed_windows_.push_back({.surface = &window->view.surface,
                               .table_from_window = view->table_from_window,
                               .parts = window->parts,
                               .brightness = exposure_,
                               .patches = window->patches ? &window->patches->patches() : nullptr,
                               .torches = window->torches});
    windows_.push_back(std::move(window));
    return true;
}

Result<void> OfflineRenderer::take_torch(const OfflineScene& scene) {
    torch_ = *scene.torch;
    beam_ = scene.setup.settings->torch.beam;
    render::GpuStore& store = renderer_->store();
    if (!torch_->picture.empty()) {
        TRY(torch_picture_, store.upload_picture(torch_->picture));
    }
    for (std::size_t k = 0; k < torch_->textures.size(); ++k) {
        scene::Drawable& drawable = parts_[k].level.drawable;
        if (!torch_->textures[k].texels.empty()) {
            TRY_VOID(store.add_layer(drawable, torch_->layer, torch_->textures[k]));
        } else if (torch_->colours[k]) {
            store.add_layer(drawable, torch_->layer, torch_->colours[k]);
        }
    }
    return {};
}

void OfflineRenderer::show_film(double seconds) {
    const auto count = static_cast<std::int64_t>(torch_->frames.size());
    const auto frame =
        static_cast<std::size_t>(static_cast<std::int64_t>(seconds * torch_->film.rate_hz) % count);
    if (frame == film_frame_) {
        return;
    }
    if (const Result<image::Image8> picture = pack::film_frame_of(torch_->film, torch_->frames[frame])) {
        renderer_->store().replace_picture(torch_picture_, image::cut_out_mips(*picture).front());
        film_frame_ = frame;
    }
}

scene::PlacedTorch OfflineRenderer::torch_at(const geometry::RigidTransform& table_from_torch,
                                             double seconds) {
    static_cast<void>(display_->make_current());
    if (!torch_->frames.empty()) {
        show_film(seconds);
    }
    scene::PlacedTorch placed = scene::placed(torch_.value().content, beam_, table_from_torch, seconds);
    placed.picture = torch_picture_;
    placed.picture_version = static_cast<std::uint32_t>(film_frame_);
    return placed;
}

void OfflineRenderer::draw_once(std::span<const scene::PlanView> views) {
    for (std::size_t eye = 0; eye < plans_.size(); ++eye) {
        scene::plan_frame(prop_, parts_, views[eye], plans_[eye]);
    }
    renderer_->draw(plans_, {display_->framebuffer(), display_->buffer_age()}, render::Redraw::Everything);
    (void)display_->present(MonotonicTime{}); // cannot fail without a screen
}

/// For several parts, the mean, weighted by the pixels of each.
std::optional<scene::ErrorEstimate> OfflineRenderer::error_in(const scene::PlanView& view,
                                                              const scene::FramePlan& plan) const {
    if (parts_.size() == 1) {
        return scene::estimate_error(shown_.front().seen, prop_, parts_.front().level, view, plan);
    }
    scene::ErrorEstimate sum;
    double pixels = 0.0;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
        const scene::PlacedLevel& level = parts_[k].level;
        const double own = scene::pixels_of(level, view);
        if (const auto error = scene::estimate_error(shown_[k].seen, prop_, level, view, plan)) {
            sum.mean_mm += own * error->mean_mm;
            sum.p95_mm += own * error->p95_mm;
            pixels += own;
        }
    }
    return pixels > 0.0 ? std::optional(scene::ErrorEstimate{sum.mean_mm / pixels, sum.p95_mm / pixels})
                        : std::nullopt;
}

std::optional<scene::ErrorEstimate> OfflineRenderer::error_of(std::span<const scene::PlanView> views) const {
    std::optional<scene::ErrorEstimate> worst;
    for (std::size_t eye = 0; eye < plans_.size(); ++eye) {
        worst = scene::larger(worst, error_in(views[eye], plans_[eye]));
    }
    return worst;
}

OfflinePicture OfflineRenderer::draw(const geometry::RigidTransform& table_from_prop,
                                     std::span<const glm::dvec3> eyes_m, double seconds,
                                     std::span<const scene::PlacedTorch> torches) {
    static_cast<void>(display_->make_current());
    pose_cells(seconds);
    const scene::PlanView view{.projector = projector_,
                               .table_from_projector = table_from_projector_,
                               .table_from_prop = table_from_prop,
                               .eyes_m = {},
                               .light = light_,
                               .brightness = exposure_,
                               .torches = torches,
                               .windows = placed_windows_};
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
