#include "app/programs/bake/put_site.h"

#include "app/pack/pack_file.h"
#include "app/pack/pack_site.h"
#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/source_scene.h"
#include "assets_baked/bake/world_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace frustumscreen::programs {

namespace {

Result<bake::BoxFrame> frame_of(const bake::SourceMesh& mesh, const bake::BakeOptions& options) {
    const std::string up = options.up.empty() ? std::string(1, mesh.default_up) : options.up;
    return bake::make_box_frame(mesh, {up, options.turn_deg, options.lift});
}

/// The box of a region, in metres of a prop of usual size, when it fills the prop.
double region_metres_per_box(const pack::Pack& region, const bake::BakedProp& prop) {
    return pack::place(region, prop.shape).metres_per_box;
}

/// As high as its lowest places that are seen from above, but for a few of them, which may be holes.
glm::dvec3 place_of(const bake::SourceScene& scene, const pack::PackCell& region) {
    constexpr int rows = 24;
    constexpr double below = 0.05; ///< share of the places
    constexpr double above_box = 2.0;
    const glm::dvec3 size = region.high - region.low;
    std::vector<double> heights;
    for (int k = 0; k < rows * rows; ++k) {
        const glm::dvec2 share((k % rows + 0.5) / rows, (k / rows + 0.5) / rows);
        const glm::dvec3 from(glm::dvec2(region.low) + share * glm::dvec2(size), above_box);
        const bake::SurfaceHit hit = scene.trace(glm::vec3(from), glm::vec3(0.0F, 0.0F, -1.0F));
        if (hit.hit) {
            heights.push_back(
                std::clamp(above_box - static_cast<double>(hit.distance), region.low.z, region.high.z));
        }
    }
    const glm::dvec3 middle = glm::mix(region.low, region.high, 0.5);
    if (heights.empty()) {
        return {middle.x, middle.y, region.low.z};
    }
    const auto lowest =
        heights.begin() + static_cast<std::ptrdiff_t>(below * static_cast<double>(heights.size()));
    std::nth_element(heights.begin(), lowest, heights.end());
    return {middle.x, middle.y, *lowest};
}

std::vector<glm::dvec3> places_of(const bake::SourceMesh& mesh, const bake::BoxFrame& frame,
                                  const std::vector<pack::PackCell>& regions) {
    const std::vector<glm::dvec3> points = bake::in_box(mesh, frame);
    const bake::SourceScene scene(mesh, points);
    std::vector<glm::dvec3> places;
    for (const pack::PackCell& region : regions) {
        if (region.cell.has_geometry) {
            places.push_back(place_of(scene, region));
        }
    }
    return places;
}

std::vector<std::string> report_of(const pack::PackWorld& world, const std::vector<pack::Pack>& regions,
                                   const bake::BakedProp& prop) {
    std::size_t finest = 0, coarsest = 0;
    std::uint64_t fewest = world.cells.front().triangles, most = 0;
    double finest_mm = 0.0, coarsest_mm = 0.0;
    for (std::size_t k = 0; k < regions.size(); ++k) {
        const pack::Pack& region = regions[k];
        if (region.levels.empty()) {
            continue;
        }
        const double mm = 1e3 * region_metres_per_box(region, prop);
        fewest = std::min(fewest, world.cells[k].triangles);
        most = std::max(most, world.cells[k].triangles);
        finest += region.levels.back().indices.size() / 3;
        coarsest += region.levels.front().indices.size() / 3;
        finest_mm = std::max(finest_mm, mm * static_cast<double>(region.levels.back().error.mean_box));
        coarsest_mm = std::max(coarsest_mm, mm * static_cast<double>(region.levels.front().error.mean_box));
    }
    return {fmt::format("{} regions of {} to {} triangles; one fills the prop at a time", world.cells.size(),
                        fewest, most),
            fmt::format("finest levels: {} triangles in all, mean error of a region up to {:.3f} mm", finest,
                        finest_mm),
            fmt::format("coarsest levels: {} triangles in all, mean error of a region up to {:.3f} mm",
                        coarsest, coarsest_mm)};
}

} // namespace

Result<void> check_site(const bake::SourceMesh& mesh, const bake::SiteOptions& site,
                        const bake::BakeOptions& options) {
    TRY(const bake::BoxFrame frame, frame_of(mesh, options));
    return without_value(bake::cut_site(mesh, frame, site));
}

Result<MadeSite> put_site(pack::Pack& pack, const bake::SourceMesh& mesh, const bake::SiteOptions& site,
                          const bake::BakeOptions& options, std::vector<bake::SourceNote>& notes) {
    TRY(const bake::BoxFrame frame, frame_of(mesh, options));
    TRY(const bake::SourceMesh regions, bake::cut_site(mesh, frame, site));
    bake::WorldCells cells = bake::bake_cells(regions, frame, options, bake::CellSides::OfSite);
    notes.insert(notes.end(), cells.notes.begin(), cells.notes.end());
    for (std::size_t k = 0; k < cells.cells.size(); ++k) {
        cells.geometry[k].provenance = pack.provenance;
        cells.geometry[k].provenance.source_triangles = cells.cells[k].triangles;
    }
    MadeSite made{.world = {.cells = std::move(cells.cells), .behaviours = {}}, .told = {}};
    TRY_VOID(pack::put_world(pack, made.world, cells.geometry));
    pack::put_site({.max_triangles = site.max_triangles, .places = places_of(mesh, frame, made.world.cells)},
                   pack);
    TRY_VOID(without_value(pack::site_regions_of(pack)));
    made.told = report_of(made.world, cells.geometry, options.prop);
    return made;
}

} // namespace frustumscreen::programs
