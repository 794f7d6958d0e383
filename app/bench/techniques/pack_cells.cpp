#include "app/bench/techniques/pack_cells.h"

#include "app/pack/pack_relief.h"
#include "app/pack/pack_world.h"
#include "app/render/hit_points.h"
#include "app/scene/cell_plan.h"
#include "app/scene/frame_plan.h"
#include "app/scene/part_cost.h"
#include "app/scene/scene_level.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace frustumscreen::bench {

namespace {

/// A cell in its way.
struct DrawnCell {
    std::size_t cell = 0; ///< index into the world's cells
    pack::VerifiedPack pack;
    double metres_per_box = 0.0;
    scene::PartWay way;
    std::shared_ptr<const relief::BlockRelief> relief; ///< null: a level
};

Result<std::shared_ptr<const relief::BlockRelief>> relief_of(const pack::Pack& pack, std::uint32_t texels) {
    TRY(const std::vector<pack::ReliefOutline> reliefs, pack::reliefs_of(pack));
    const auto found =
        std::find_if(reliefs.begin(), reliefs.end(),
                     [texels](const pack::ReliefOutline& each) { return each.texels == texels; });
    TRY(relief::BlockRelief read, pack::relief_of(pack, *found));
    return std::make_shared<const relief::BlockRelief>(std::move(read));
}

Result<std::vector<DrawnCell>> read_cells(const Kiosk& kiosk, const std::filesystem::path& file,
                                          const pack::PackWorld& world,
                                          std::span<const world::CellPose> poses, double metres_per_box) {
    const settings::ProjectorSettings& projector = kiosk.settings.projector;
    const double tolerance_mm =
        1e3 * kiosk.settings.render.error_tolerance_px *
        scene::pixel_on_prop_m(kiosk.prop, projector.pinhole, projector.table_from_projector.inverse());
    std::vector<DrawnCell> drawn;
    std::vector<scene::PartWays> ways;
    for (std::size_t k = 0; k < world.cells.size(); ++k) {
        if (world.cells[k].cell.has_geometry) {
            TRY(pack::VerifiedPack pack, pack::load_cell(file, world.cells[k]));
            const double own = scene::metres_per_box_of(poses[k], metres_per_box);
            TRY(scene::PartWays way, scene::good_ways(pack::outline_of(*pack), 1e3 * own, tolerance_mm));
            ways.push_back(std::move(way));
            drawn.push_back({k, std::move(pack), own, {}, nullptr});
        }
    }
    const scene::PartFrame frame = scene::quickest_frame(ways);
    for (std::size_t k = 0; k < drawn.size(); ++k) {
        drawn[k].way = frame.ways[k];
        if (drawn[k].way.way.relief) {
            TRY(drawn[k].relief, relief_of(*drawn[k].pack, drawn[k].way.way.level));
        }
    }
    return drawn;
}

class PackCellsTechnique final : public Technique {
public:
    PackCellsTechnique(const Kiosk& kiosk, std::optional<PictureLight> light, std::vector<scene::Part> parts,
                       std::string name, render::Renderer renderer, render::HitPointRenderer hit_points)
        : kiosk_(kiosk), light_(std::move(light)), parts_(std::move(parts)), name_(std::move(name)),
          renderer_(std::move(renderer)), hit_points_(std::move(hit_points)) {
        std::size_t indices = 0;
        for (const scene::Part& part : parts_) {
            indices += part.level.triangles ? part.level.triangles->indices.size() : 0;
        }
        plans_.push_back(scene::make_plan(kiosk.prop, indices, parts_.size()));
    }

    [[nodiscard]] std::string name() const override { return name_; }
    void draw(const BenchPose& pose) override {
        plan(pose);
        renderer_.draw(plans_, {kiosk_.framebuffer, 0}, render::Redraw::Everything);
    }
    [[nodiscard]] Result<image::ImageFloat> hit_points(const BenchPose& pose) override {
        plan(pose);
        return hit_points_.draw(plans_.front(), renderer_.store());
    }

private:
    void plan(const BenchPose& pose) {
        const settings::ProjectorSettings& projector = kiosk_.settings.projector;
        scene::PlanView view{.projector = projector.pinhole,
                             .table_from_projector = projector.table_from_projector,
                             .table_from_prop = pose.table_from_prop,
                             .eyes_m = {&pose.eye_m, 1},
                             .light = {},
                             .brightness = 1.0};
        if (light_) {
            view.light = light_->compensation;
            view.brightness = light_->exposure;
        }
        scene::plan_frame(kiosk_.prop, parts_, view, plans_.front());
    }

    const Kiosk& kiosk_;
    std::optional<PictureLight> light_;
    std::vector<scene::Part> parts_;
    std::string name_;
    render::Renderer renderer_;
    render::HitPointRenderer hit_points_;
    std::vector<scene::FramePlan> plans_;
};

scene::RenderNeeds needs_of(const std::vector<DrawnCell>& cells, int samples) {
    scene::RenderNeeds needs{std::max(samples, render::default_samples),
                             {{scene::ShaderKey::Pass::EdgeFeather}}};
    for (const DrawnCell& cell : cells) {
        if (cell.relief) {
            needs.draws.insert(scene::raster_shader());
            needs.rasterizes = true;
            continue;
        }
        for (const bool lit : {false, true}) {
            scene::ShaderKey shader{.even_light = lit};
            shader.cut_out = scene::whole_level(*cell.pack, cell.way.way.level).cut_out;
            needs.draws.insert(shader);
        }
    }
    return scene::with_cells(std::move(needs));
}

Result<scene::PlacedLevel> upload(const DrawnCell& cell, render::GpuStore& store) {
    if (cell.relief) {
        return scene::placed(*cell.pack, cell.relief, cell.metres_per_box, store.keep(cell.relief));
    }
    const scene::SceneLevel level = scene::whole_level(*cell.pack, cell.way.way.level);
    TRY(const scene::Drawable drawable, store.upload(level, cell.pack->textures[level.mesh.texture]));
    return scene::placed(*cell.pack, cell.way.way.level, cell.metres_per_box, drawable);
}

std::string described(const pack::PackWorld& world, const DrawnCell& cell, std::uint64_t work) {
    return fmt::format("  {}: {} of {} {}{}\n", world.cells[cell.cell].cell.name,
                       scene::name_of(cell.way.way), work, cell.relief ? "blocks" : "triangles",
                       cell.way.way.enough ? "" : ", beyond the tolerance");
}

} // namespace

Result<PackCells> make_pack_cells(const Kiosk& kiosk, const std::filesystem::path& file,
                                  const pack::Pack& whole, const PictureOptions& options, std::string name) {
    TRY(const pack::PackWorld world, pack::world_of(whole));
    const std::vector<world::CellPose> poses = world::poses_at_rest(pack::tree_of(world));
    const double metres_per_box = pack::place(whole, kiosk.prop).metres_per_box;
    TRY(const std::vector<DrawnCell> cells, read_cells(kiosk, file, world, poses, metres_per_box));
    const int samples = options.samples > 0 ? options.samples : whole.samples;
    std::optional<PictureLight> light;
    if (options.lit || options.timed_lit) {
        TRY(light, shown_light(kiosk, whole));
    }
    TRY(render::Renderer renderer,
        render::Renderer::create(kiosk.width(), kiosk.height(), needs_of(cells, samples)));
    TRY(render::HitPointRenderer hit_points, render::HitPointRenderer::create(renderer));
    PackCells made;
    std::vector<scene::Part> parts;
    for (const DrawnCell& cell : cells) {
        TRY(scene::PlacedLevel placed, upload(cell, renderer.store()));
        placed.samples = samples;
        scene::set_pose(placed, poses[cell.cell], metres_per_box);
        const std::uint64_t work = cell.relief ? cell.relief->blocks.size()
                                               : cell.pack->levels[cell.way.way.level].indices.size() / 3;
        (cell.relief ? made.blocks : made.triangles) += work;
        made.ways += described(world, cell, work);
        parts.push_back({std::move(placed), std::nullopt});
    }
    made.technique =
        std::make_unique<PackCellsTechnique>(kiosk, std::move(light), std::move(parts), std::move(name),
                                             std::move(renderer), std::move(hit_points));
    return made;
}

} // namespace frustumscreen::bench
