#include "app/bench/mixed/cell_set.h"

#include "app/pack/pack_world.h"
#include "app/render/level_upload.h"
#include "app/render/read_back.h"
#include "app/scene/cell_plan.h"
#include "app/world/player.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::bench {

namespace {

/// Runs for ever, and every cell stays as it is.
pack::PackBehaviour stillness() {
    pack::PackBehaviour still;
    still.behaviour.name = "still";
    still.behaviour.seconds = 1.0;
    still.behaviour.repeats = true;
    still.behaviour.channels = {{.cell = 0,
                                 .path = world::Path::Light,
                                 .curve = {.interpolation = world::Interpolation::Step,
                                           .times_s = {0.0F},
                                           .values = {glm::vec4(1.0F, 1.0F, 1.0F, 0.0F)}}}};
    return still;
}

scene::SceneRequest request_for(int samples) {
    scene::SceneRequest request;
    request.light = false;
    request.samples = samples;
    request.sample_headroom = render::default_samples;
    request.cull_kinds =
        scene::AllCullKinds & ~static_cast<unsigned>(scene::UnseenTriangles | scene::UnusedDetail);
    return request;
}

} // namespace

Result<std::unique_ptr<CellSet>> CellSet::open(const settings::Settings& settings,
                                               const std::filesystem::path& pack, int samples,
                                               std::optional<std::uint8_t> torch) {
    TRY(pack::PackWorld world, pack::load_world(pack));
    if (std::none_of(world.cells.begin(), world.cells.end(),
                     [](const pack::PackCell& cell) { return cell.cell.has_geometry; })) {
        return bad_input("bench.no_cells",
                         "{}: the pack has no cells; bake it with --cells nodes, of a model that has parts",
                         pack.string());
    }
    scene::ScenePlan plan;
    int of_pack = 0;
    const auto choose = [&](const pack::PackOutline& outline) -> Result<std::vector<std::uint32_t>> {
        of_pack = samples > 0 ? samples : outline.description.samples;
        TRY(plan, scene::plan_scene(settings, outline, request_for(of_pack)));
        return std::vector<std::uint32_t>{};
    };
    TRY_VOID(without_value(pack::load_pack(pack, choose)));
    world.behaviours = {stillness()};
    std::unique_ptr<CellSet> made(new CellSet(settings, std::move(plan)));
    made->whole_.samples = of_pack;
    TRY(made->known_,
        residency::open_cells(settings, pack, std::move(world), made->plan_, request_for(of_pack)));
    TRY(made->prepared_, residency::prepare_cells(pack, *made->known_, [] { return false; }));
    TRY_VOID(made->upload(torch));
    made->list_ways();
    return made;
}

Result<void> CellSet::upload(std::optional<std::uint8_t> torch) {
    const geometry::Pinhole& pinhole = settings_.projector.pinhole;
    TRY(display_, display::SurfacelessDisplay::create(pinhole.width, pinhole.height));
    scene::RenderNeeds needs = residency::needs_of(*known_, plan_.needs);
    if (torch) {
        needs = scene::with_torch(std::move(needs), *torch);
        needs = scene::with_torch(std::move(needs), *torch | torch::BarePart);
    }
    TRY(renderer_, render::Renderer::create(pinhole.width, pinhole.height, needs));
    for (const residency::PreparedLevel& level : prepared_.levels) {
        render::LevelUpload upload(level.data);
        TRY_VOID(upload.go_on());
        const std::optional<std::size_t> shared = level.data.texture_of;
        const scene::TextureId texture =
            shared ? drawables_[*shared].material.texture : scene::TextureId::None;
        drawables_.push_back(renderer_->store().keep(std::move(upload), texture));
    }
    TRY(hit_points_, render::HitPointRenderer::create(*renderer_));
    return {};
}

void CellSet::list_ways() {
    const std::vector<world::CellPose> at_rest = world::poses_at_rest(pack::tree_of(known_->world));
    std::size_t place = 0;
    for (std::size_t k = 0; k < known_->drawn.size(); ++k) {
        const residency::KnownCell& known = known_->drawn[k];
        CellWays ways;
        for (std::size_t way = 0; way < prepared_.options[k]; ++way, ++place) {
            const residency::PreparedLevel& level = prepared_.levels[place];
            const std::size_t indices = level.triangles ? level.triangles->indices.size() : 0;
            CellWay made{.placed = {.triangles = level.triangles,
                                    .box_size = level.box_size,
                                    .metres_per_box = known.plan.metres_per_box,
                                    .drawable = drawables_[place],
                                    .samples = whole_.samples,
                                    .faces = known.plan.faces,
                                    .relief = level.data.relief,
                                    .on_gpu = level.data.on_gpu},
                         .worst_mm = 1e3 * known.plan.metres_per_box *
                                     static_cast<double>(scene::worst_of(level.seen).mean_box),
                         .triangles = static_cast<double>(level.data.relief ? level.data.relief->blocks.size()
                                                                            : indices / 6),
                         .polygons = indices / 3,
                         .texel_m = level.data.relief ? known.plan.metres_per_box / level.use.level : 0.0};
            scene::set_pose(made.placed, at_rest[known.cell], plan_.metres_per_box);
            max_indices_ += indices;
            if (!level.data.on_gpu) {
                (level.data.relief ? ways.reliefs : ways.meshes).push_back(std::move(made));
            }
        }
        std::stable_sort(ways.meshes.begin(), ways.meshes.end(),
                         [](const CellWay& a, const CellWay& b) { return a.polygons > b.polygons; });
        std::stable_sort(ways.reliefs.begin(), ways.reliefs.end(),
                         [](const CellWay& a, const CellWay& b) { return a.texel_m > b.texel_m; });
        cells_.push_back(std::move(ways));
    }
}

scene::PlanView CellSet::view(const BenchPose& pose) const {
    return {.projector = settings_.projector.pinhole,
            .table_from_projector = settings_.projector.table_from_projector,
            .table_from_prop = pose.table_from_prop,
            .eyes_m = {&pose.eye_m, 1}};
}

std::unique_ptr<residency::RunCells> CellSet::run_cells(double deadline_ms,
                                                        const scene::FrameCost& cost) const {
    auto made = std::make_unique<residency::RunCells>(
        known_->world, *known_, plan_, std::span<const residency::PreparedLevel>(), prepared_, deadline_ms);
    for (std::size_t place = 0; place < drawables_.size(); ++place) {
        made->give(place, drawables_[place], renderer_->store());
    }
    made->start(cost);
    return made;
}

image::ImageFloat CellSet::hit_points(const scene::FramePlan& plan) {
    return hit_points_->draw(plan, renderer_->store());
}

void CellSet::read_colour_into(image::Image8& picture) const {
    const geometry::Pinhole& pinhole = settings_.projector.pinhole;
    if (picture.width == 0) {
        picture = image::Image8(pinhole.width, pinhole.height);
    }
    render::read_colour_into(display_->framebuffer(), picture);
}

} // namespace frustumscreen::bench
