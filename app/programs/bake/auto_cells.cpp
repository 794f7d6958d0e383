#include "app/programs/bake/auto_cells.h"

#include "app/pack/pack_outline.h"
#include "app/scene/part_cost.h"
#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/surface_parts.h"
#include "assets_baked/bake/world_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace frustumscreen::programs {

namespace {

constexpr std::size_t max_parts = 12;

/// On a prop of usual size.
double mm_per_box_of(const pack::Pack& pack, const bake::BakedProp& prop) {
    const geometry::PropShape usual =
        prop.kind == "frustum" ? geometry::make_frustum(geometry::FrustumSize{}) : prop.shape;
    return 1e3 * pack::place(pack, usual).metres_per_box;
}

/// The longest edge of the box of a cell with geometry.
double length_of(const pack::PackCell& cell) {
    const glm::dvec3 size = cell.high - cell.low;
    return std::max({size.x, size.y, size.z});
}

Result<scene::PartFrame> frame_in(const bake::WorldCells& cells, double mm_per_box) {
    std::vector<scene::PartWays> parts;
    for (std::size_t k = 0; k < cells.cells.size(); ++k) {
        TRY(scene::PartWays ways,
            scene::good_ways(pack::outline_of(cells.geometry[k]), mm_per_box * length_of(cells.cells[k]),
                             scene::near_tolerance_mm));
        parts.push_back(std::move(ways));
    }
    return scene::quickest_frame(parts);
}

/// True if each cell keeps the tolerance of the whole.
bool all_enough(const scene::PartFrame& frame) {
    return std::all_of(frame.ways.begin(), frame.ways.end(),
                       [](const scene::PartWay& way) { return way.way.enough; });
}

/// Cells without geometry move nothing at rest.
void drop_empty(bake::WorldCells& cells) {
    for (std::size_t k = cells.cells.size(); k-- > 0;) {
        if (!cells.cells[k].cell.has_geometry) {
            cells.cells.erase(cells.cells.begin() + static_cast<std::ptrdiff_t>(k));
            cells.geometry.erase(cells.geometry.begin() + static_cast<std::ptrdiff_t>(k));
        }
    }
}

} // namespace

Result<AutoCells> put_auto_cells(pack::Pack& pack, const bake::SourceMesh& mesh,
                                 const bake::BakeOptions& options) {
    const std::string up = options.up.empty() ? std::string(1, mesh.default_up) : options.up;
    TRY(const bake::BoxFrame frame, bake::make_box_frame(mesh, {up, options.turn_deg, options.lift}));
    const double mm_per_box = mm_per_box_of(pack, options.prop);
    TRY(const scene::PartWays whole_ways,
        scene::good_ways(pack::outline_of(pack), mm_per_box, scene::near_tolerance_mm));
    const scene::PartFrame whole = scene::quickest_frame({&whole_ways, 1});
    const scene::PartCosts& costs = scene::usual_part_costs;
    const double picture =
        options.relief ? std::min(costs.mesh_picture, costs.relief_picture) : costs.mesh_picture;
    const double least = picture + costs.per_part;
    if (!scene::cells_pay(whole.cost, least)) {
        return AutoCells{
            {}, fmt::format("one cell: {:.1f} floors whole, at least {:.1f} in cells", whole.cost, least)};
    }
    // A part saves at most its share of the whole's time.
    const bake::SurfaceParts parts =
        bake::find_parts(mesh, costs.per_part / (whole.cost - picture), max_parts);
    if (parts.count < 2) {
        return AutoCells{
            {},
            fmt::format("one cell: {:.1f} floors whole, and no part of it could save more than its own cost",
                        whole.cost)};
    }
    const bake::SourceMesh in_parts = bake::with_parts(mesh, parts, frame, options.prop.zone);
    bake::WorldCells cells = bake::bake_cells(in_parts, frame, options, bake::CellSides::SeenAtRest);
    drop_empty(cells);
    TRY(const scene::PartFrame in_cells, frame_in(cells, mm_per_box));
    if (cells.cells.size() < 2 || !all_enough(in_cells) || !scene::cells_pay(whole.cost, in_cells.cost)) {
        return AutoCells{{},
                         fmt::format("one cell: {:.1f} floors whole, {:.1f} in {} cells{}", whole.cost,
                                     in_cells.cost, cells.cells.size(),
                                     all_enough(in_cells) ? "" : ", of which some would err more")};
    }
    for (std::size_t k = 0; k < cells.cells.size(); ++k) {
        cells.geometry[k].provenance = pack.provenance;
        cells.geometry[k].provenance.source_triangles = cells.cells[k].triangles;
    }
    pack::PackWorld world{.cells = std::move(cells.cells), .behaviours = {}, .drawn_at_rest = true};
    TRY_VOID(pack::put_world(pack, world, cells.geometry));
    return AutoCells{std::move(world), fmt::format("{} cells: {:.1f} floors, {:.1f} whole",
                                                   in_cells.ways.size(), in_cells.cost, whole.cost)};
}

} // namespace frustumscreen::programs
