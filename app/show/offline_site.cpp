#include "app/show/offline_site.h"

#include "app/pack/pack_file.h"
#include "app/pack/pack_site.h"
#include "app/pack/pack_world.h"
#include "app/scene/beyond_prop.h"
#include "app/scene/visible_triangles.h"
#include "app/world/cell.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

namespace frustumscreen::show {

namespace {

/// Twice the area of a, b, c seen from above; positive: counter-clockwise.
double area_above(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Where a vertical line meets the triangle; none: it passes.
std::optional<double> height_in(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                const glm::dvec2& place) {
    const double of_a = area_above(b, c, place);
    const double of_b = area_above(c, a, place);
    const double of_c = area_above(a, b, place);
    const bool inside =
        (of_a >= 0.0 && of_b >= 0.0 && of_c >= 0.0) || (of_a <= 0.0 && of_b <= 0.0 && of_c <= 0.0);
    const double area = of_a + of_b + of_c;
    return inside && area != 0.0 ? std::optional((of_a * a.z + of_b * b.z + of_c * c.z) / area)
                                 : std::nullopt;
}

/// The highest surface of a region's finest level above the place; none: nothing is there.
Result<std::optional<double>> surface_above(const std::filesystem::path& file, const pack::PackCell& cell,
                                            const world::CellPose& at_rest, const glm::dvec2& place) {
    TRY(const pack::VerifiedPack pack,
        pack::load_cell(file, cell,
                        [](const pack::PackOutline& outline) -> Result<std::vector<std::uint32_t>> {
                            return std::vector{static_cast<std::uint32_t>(outline.levels.size() - 1)};
                        }));
    const scene::LevelTriangles level = scene::triangles_of(pack->levels.back(), pack->box_size);
    std::vector<glm::dvec3> points;
    points.reserve(level.positions.size());
    for (const glm::vec3& position : level.positions) {
        points.emplace_back(at_rest.box_from_geometry * glm::dvec4(position, 1.0));
    }
    std::optional<double> highest;
    for (std::size_t k = 0; k + 2 < level.indices.size(); k += 3) {
        const std::optional<double> height = height_in(points[level.indices[k]], points[level.indices[k + 1]],
                                                       points[level.indices[k + 2]], place);
        highest = height ? std::max(highest.value_or(*height), *height) : highest;
    }
    return highest;
}

} // namespace

Result<world::SiteView> offline_site_view(const std::filesystem::path& file,
                                          const pack::PackDescription& pack, const scene::ScenePlan& whole,
                                          const OfflineSite& site) {
    TRY(const std::vector<pack::SiteRegion> packed, pack::site_regions_of(pack));
    if (packed.empty()) {
        return bad_input("render.no_site", "--site: the pack is not a site; bake it with [site] in its "
                                           "artifact.toml, or leave the option out");
    }
    std::vector<world::RegionBox> regions;
    for (const pack::SiteRegion& region : packed) {
        regions.push_back({region.low, region.high});
    }
    const std::optional<std::size_t> region = world::region_at(regions, site.place_box);
    if (!region) {
        return bad_input("render.off_site",
                         "--site: no region of the site is at {:.4f}, {:.4f}; its ground reaches to {:.4f} "
                         "and {:.4f} on each side of the "
                         "middle",
                         site.place_box.x, site.place_box.y, 0.5 * pack.box_size.x, 0.5 * pack.box_size.y);
    }
    TRY(const pack::PackWorld world, pack::world_outline_of(pack));
    const std::vector<world::CellPose> at_rest = world::poses_at_rest(pack::tree_of(world));
    std::vector<std::size_t> drawn; // the cell of each region
    for (std::size_t k = 0; k < world.cells.size(); ++k) {
        if (world.cells[k].cell.has_geometry) {
            drawn.push_back(k);
        }
    }
    const std::size_t cell = drawn.at(*region);
    TRY(const std::optional<double> surface,
        surface_above(file, world.cells[cell], at_rest[cell], site.place_box));
    const geometry::Box prop = scene::box_around(whole.prop);
    const double half_prop = 0.5 * (prop.high.z - prop.low.z) / (site.zoom * whole.metres_per_box);
    const double ground = regions[*region].low.z;
    return world::view_of({site.place_box, surface ? std::max(ground, *surface - half_prop) : ground},
                          site.zoom);
}

} // namespace frustumscreen::show
