// A window whose patches are block reliefs: the eye on its plane and behind it, on the borders of patches, depths that differ a
// millionfold, worlds that no eye sees.

#include "app/bench/stability/themes.h"
#include "app/ldi/patch_relief.h"
#include "app/relief/relief_painter.h"
#include "app/scene/flat_screen.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

namespace frustumscreen::bench {

namespace {

constexpr double radius_m = 0.5;
constexpr double half_m = 0.1;
constexpr int px = 64;
constexpr double texel_m = 2.0 * half_m / px;
const ldi::PatchLimits limits{.half_extent_m = glm::dvec2(half_m), .texel_m = texel_m};

/// Adds a square wall parallel to the window.
void add_wall(ldi::TriangleWorld& world, double z, double half_extent_m) {
    const auto first = static_cast<std::uint32_t>(world.positions.size());
    for (const glm::dvec2& corner :
         {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(1, 1)}) {
        world.positions.emplace_back(half_extent_m * corner.x, half_extent_m * corner.y, z);
    }
    for (const std::uint32_t corner : {0U, 1U, 2U, 2U, 1U, 3U}) {
        world.indices.push_back(first + corner);
    }
}

/// The hit points of an eye's picture, window frame; NaN where there is none.
std::vector<glm::dvec3> hits(const ldi::PatchRelief& patch, const glm::dvec3& eye) {
    const scene::FlatScreen screen = scene::flat_screen({glm::dvec3(-half_m, half_m, 0.0),
                                                         {half_m, half_m, 0.0},
                                                         {half_m, -half_m, 0.0},
                                                         {-half_m, -half_m, 0.0}},
                                                        px, px);
    relief::RasterScene scene;
    scene.prop_from_box = patch.window_from_box;
    scene.box_size = patch.box_size;
    scene.projector = screen.pinhole;
    scene.prop_from_projector = screen.table_from_pinhole;
    scene.eye_m = eye;
    relief::RasterView view;
    relief::set_up(view, screen.surface, scene);
    std::vector<glm::vec3> points(static_cast<std::size_t>(px) * px);
    relief::ReliefPainter(1).hit_points(patch.relief, view, {points.data(), px, px, px});
    std::vector<glm::dvec3> placed;
    for (const glm::vec3& point : points) {
        placed.emplace_back(patch.window_from_box * glm::dvec4(glm::dvec3(point), 1.0));
    }
    return placed;
}

double count(const std::vector<glm::dvec3>& points) {
    return static_cast<double>(
        std::count_if(points.begin(), points.end(), [](const glm::dvec3& at) { return !std::isnan(at.x); }));
}

/// The largest distance of a hit from the plane at z.
double off_plane(const std::vector<glm::dvec3>& points, double z) {
    double most = 0.0;
    for (const glm::dvec3& at : points) {
        most = std::isnan(at.z) ? most : std::max(most, std::abs(at.z - z));
    }
    return most;
}

StabilityResult on_the_plane_and_behind(const StabilityOptions&) {
    ldi::TriangleWorld world;
    add_wall(world, -0.1, 0.4);
    add_wall(world, 0.02, 0.02);
    const ldi::PatchRelief patch = ldi::make_patch_relief(world, ldi::Hemisphere(radius_m), 0, limits);
    double drawn = 0.0;
    for (const double z : {0.0, -1e-300, -1e-12, -1e-3, -0.1, -2.0, -1e9}) {
        for (const glm::dvec2& beside : {glm::dvec2(0.0), glm::dvec2(0.05, -0.1), glm::dvec2(0.3, 0.1)}) {
            drawn += count(hits(patch, {beside, z}));
        }
    }
    const double control = count(hits(patch, {0.0, 0.0, radius_m}));
    return {{{"pixels drawn", 0.0, drawn},
             {"pixels drawn for an eye before it, short of all", 0.0, px * px - control}}};
}

StabilityResult borders(const StabilityOptions&) {
    constexpr double wall_z = -0.1;
    ldi::TriangleWorld world;
    add_wall(world, wall_z, 0.6);
    const ldi::Hemisphere hemisphere(radius_m);
    std::vector<ldi::PatchRelief> patches;
    for (std::size_t patch = 0; patch < ldi::patch_count; ++patch) {
        patches.push_back(ldi::make_patch_relief(world, hemisphere, patch, limits));
    }
    double off = 0.0;
    double missing = 0.0;
    for (std::size_t ring = 1; ring < ldi::patch_count; ++ring) {
        const ldi::PatchDirections& directions = hemisphere.directions_of(ring);
        const auto eye = [&](double polar, double azimuth) {
            return radius_m * glm::dvec3(std::sin(polar) * std::cos(azimuth),
                                         std::sin(polar) * std::sin(azimuth), std::cos(polar));
        };
        const double side = directions.middle_azimuth_rad + directions.half_width_rad;
        const std::size_t next = ring % (ldi::patch_count - 1) + 1;
        for (const double beside : {-1e-15, 0.0, 1e-15}) {
            for (const auto& [polar, azimuth, other] :
                 {std::tuple(directions.min_polar_rad + beside, directions.middle_azimuth_rad,
                             std::size_t{0}),
                  std::tuple(directions.min_polar_rad + beside, side + beside, std::size_t{0}),
                  std::tuple(0.5 * (directions.min_polar_rad + directions.max_polar_rad), side + beside,
                             next),
                  std::tuple(directions.max_polar_rad, side + beside, next)}) {
                for (const std::size_t patch : {ring, other}) {
                    const std::vector<glm::dvec3> seen = hits(patches[patch], eye(polar, azimuth));
                    off = std::max(off, off_plane(seen, wall_z) / texel_m);
                    missing += px * px - count(seen);
                }
            }
        }
    }
    return {{{"both sides: a wall off, in texels", 0.01, off},
             {"both sides: pixels without a hit", 0.0, missing}}};
}

StabilityResult depths(const StabilityOptions&) {
    constexpr double far_m =
        100.0; // the eye sees the box's middle at a sine of some 0.01; 0.001 is the least (collineation.h)
    ldi::TriangleWorld world;
    add_wall(world, -1e-6 * far_m, 0.02);
    add_wall(world, -far_m, 4.0 * far_m);
    const ldi::Hemisphere hemisphere(radius_m);
    ldi::PatchLimits tight = limits;
    tight.max_bytes = std::uint64_t{8} << 20U;
    const ldi::PatchRelief patch = ldi::make_patch_relief(world, hemisphere, 0, tight);
    const std::vector<glm::dvec3> seen = hits(patch, {0.01, 0.02, radius_m});
    return {{{"the far wall off, in its texels", 0.01, off_plane(seen, -far_m) / patch.texel_m},
             {"pixels without a hit", 0.0, px * px - count(seen)},
             {"bytes above the limit", 0.0,
              std::max(0.0, static_cast<double>(relief::bytes_of(patch.relief)) -
                                static_cast<double>(tight.max_bytes))}}};
}

StabilityResult nothing_seen(const StabilityOptions&) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    ldi::TriangleWorld beside;
    add_wall(beside, 3.0, 1.0); // behind all eyes
    ldi::TriangleWorld broken;
    broken.positions = {{0, 0, nan}, {1, 0, -1}, {0, infinity, -1}, {1, 1, -1}};
    broken.indices = {0, 1, 3, 1, 2, 3, 1, 3, 9, 3, 3, 3};
    double drawn = 0.0;
    for (const ldi::TriangleWorld& world : {ldi::TriangleWorld{}, beside, broken}) {
        for (const std::size_t number : {std::size_t{0}, std::size_t{5}}) {
            const ldi::PatchRelief patch =
                ldi::make_patch_relief(world, ldi::Hemisphere(radius_m), number, limits);
            drawn +=
                static_cast<double>(patch.relief.blocks.size()) + count(hits(patch, {0.0, 0.0, radius_m}));
        }
    }
    return {{{"blocks, and pixels drawn", 0.0, drawn}}};
}

} // namespace

std::vector<StabilityCase> patch_relief_cases() {
    const auto strict = FloatingPoint::Strict;
    return {{"layered depth", "patch as a relief: an eye on the window's plane and behind it", strict,
             on_the_plane_and_behind},
            {"layered depth", "patch as a relief: on the borders of patches", strict, borders},
            {"layered depth", "patch as a relief: depths that differ a millionfold", strict, depths},
            {"layered depth", "patch as a relief: worlds of which nothing is seen", FloatingPoint::Free,
             nothing_seen}};
}

} // namespace frustumscreen::bench
