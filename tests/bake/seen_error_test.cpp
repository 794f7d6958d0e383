// Errors of a level as eyes see it, compared with known geometry.
#include "assets_baked/bake/block_relief.h"
#include "assets_baked/bake/level.h"
#include "tests/bake/shapes.h"

#include <glm/gtx/component_wise.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace frustumscreen::bake {

namespace {

constexpr double radius = 0.5;

/// A pack with one level, the mesh.
pack::Pack pack_of(const SourceMesh& mesh) {
    pack::Pack pack;
    pack.box_size = glm::dvec3(1.0);
    pack.textures = {image::Image8(4, 4, glm::u8vec4(255))};
    pack.levels = {make_level(chart(weld(mesh, mesh.positions), 1.0F / 64.0F), pack.box_size)};
    return pack;
}

SourceMesh sphere(int rows, double smaller = 0.0) {
    SourceMesh mesh = test::empty_mesh();
    test::add_sphere(mesh, {0, 0, radius}, radius - smaller, rows);
    return mesh;
}

struct Slab {
    glm::dvec3 low, high;
};

/// Distance along the ray to the nearest box; infinite if it hits none.
double distance_to(const std::vector<Slab>& boxes, const glm::dvec3& eye, const glm::dvec3& direction) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Slab& box : boxes) {
        const glm::dvec3 a = (box.low - eye) / direction;
        const glm::dvec3 b = (box.high - eye) / direction;
        const double enter = glm::compMax(glm::min(a, b));
        if (enter <= glm::compMin(glm::max(a, b))) {
            nearest = std::min(nearest, enter);
        }
    }
    return nearest;
}

/// The mean error of `level` for an eye 6 box units from the box's middle, over 600 x 600 rays.
double exact_mean(const std::vector<Slab>& source, const std::vector<Slab>& level,
                  const glm::dvec3& towards) {
    constexpr int rays = 600;
    const glm::dvec3 middle(0.0, 0.0, 0.5);
    const glm::dvec3 eye = middle + 6.0 * towards;
    const glm::dvec3 right = glm::normalize(glm::cross(towards, glm::dvec3(0.0, 0.0, 1.0)));
    const glm::dvec3 up = glm::cross(right, towards);
    double sum = 0.0;
    double both = 0.0;
    for (int k = 0; k < rays * rays; ++k) {
        const glm::dvec3 through = middle + 2.0 * ((k % rays + 0.5) / rays - 0.5) * right +
                                   2.0 * ((k / rays + 0.5) / rays - 0.5) * up;
        const double a = distance_to(source, eye, glm::normalize(through - eye));
        const double b = distance_to(level, eye, glm::normalize(through - eye));
        if (std::isfinite(a) && std::isfinite(b)) {
            sum += std::abs(a - b);
            both += 1.0;
        }
    }
    return sum / std::max(both, 1.0);
}

} // namespace

// A plate before a wall. Both are smaller in the level by a fortieth of the distance between two of the bake's rays, so
// that only a handful of an eye's rays hit the wall beside the plate. The error for each eye is still estimated, as
// exactly as a grid of rays resolves oblique edges.
TEST(SeenError, MatchesTheExactMeanBehindOccludingEdges) {
    constexpr double less = 3e-4;
    const Slab wall{{-0.5, 0.2, 0.0}, {0.5, 0.25, 1.0}};
    const Slab plate{{-0.3, -0.25, 0.1}, {0.3, -0.2, 0.7}};
    const auto smaller = [](const Slab& box) { return Slab{box.low + less, box.high - less}; };
    const auto mesh_of = [](const Slab& one, const Slab& other) {
        SourceMesh mesh = test::empty_mesh();
        test::add_box(mesh, one.low, one.high);
        test::add_box(mesh, other.low, other.high);
        return mesh;
    };
    const SourceMesh source_mesh = mesh_of(wall, plate);
    const SourceScene source(source_mesh, source_mesh.positions);
    const pack::SeenErrors seen =
        seen_errors(pack_of(mesh_of(smaller(wall), smaller(plate))), {}, source, {});
    int compared = 0;
    for (std::size_t k = 0; k < seen.eyes.size(); ++k) {
        if (seen.eyes[k].towards.y > -0.7) {
            continue; // the plate does not hide the wall
        }
        const double exact = exact_mean({wall, plate}, {smaller(wall), smaller(plate)}, seen.eyes[k].towards);
        EXPECT_NEAR(static_cast<double>(seen.levels[0][k].mean_box), exact, 0.35 * exact) << k;
        ++compared;
    }
    EXPECT_GE(compared, 5);
}

// A sphere that is smaller by d deviates by d along the normal, and by d / cos along a ray. The mean over a disc of
// rays is 2 d, except for the rim, where rays miss the smaller sphere.
TEST(SeenError, IsTwiceTheDistanceOfASmallerSphere) {
    constexpr double smaller = 2e-3;
    const SourceMesh source_mesh = sphere(192);
    const SourceScene source(source_mesh, source_mesh.positions);
    const pack::SeenErrors seen =
        seen_errors(pack_of(sphere(192, smaller)), {}, source, ViewingZone::all_around());
    ASSERT_EQ(seen.levels.size(), 1U);
    ASSERT_EQ(seen.levels[0].size(), seen.eyes.size());
    const pack::SeenError mean = mean_of(seen.levels[0]);
    EXPECT_NEAR(static_cast<double>(mean.mean_box), 2.0 * smaller, 0.15 * smaller);
    // A ray at the share s of the radius deviates by d / sqrt(1 - s^2); s^2 < 0.95 holds for 95 % of the disc.
    EXPECT_NEAR(static_cast<double>(mean.p95_box), smaller / std::sqrt(0.05), 0.35 * smaller);
    // The rim is a ring of width d, a share 2 d / r of the disc.
    EXPECT_NEAR(static_cast<double>(mean.silhouette_share), 2.0 * smaller / radius, 0.2 * smaller / radius);
    EXPECT_GT(static_cast<double>(mean.outline_shift_box),
              0.6 * smaller); // a grid's stepped outline is longer than a circle
    EXPECT_LT(static_cast<double>(mean.outline_shift_box), 1.2 * smaller);
    for (std::size_t k = 0; k < seen.eyes.size(); ++k) {
        EXPECT_NEAR(static_cast<double>(seen.levels[0][k].mean_box), 2.0 * smaller, 0.3 * smaller);
        // Along one axis sqrt(1 + slope^2) = sqrt((1 - y^2) / (1 - x^2 - y^2)), with the mean pi / 2 over a disc; a
        // grid's rays miss the steepest rim.
        EXPECT_LT(static_cast<double>(seen.eyes[k].steepness), 0.5 * std::numbers::pi);
        EXPECT_GT(static_cast<double>(seen.eyes[k].steepness), 1.35);
        double shares = 0.0;
        glm::dvec3 middle(0.0);
        for (const pack::SeenPatch& patch : seen.eyes[k].patches) {
            shares += patch.share;
            middle += patch.share * patch.place;
        }
        EXPECT_NEAR(shares, 1.0, 1e-6);
        // The centroid of a hemisphere over a disc is at 2/3 of the radius towards the eye, which is not at infinity.
        EXPECT_LT(glm::distance(middle, glm::dvec3(0, 0, radius) + 2.0 / 3.0 * radius * seen.eyes[k].towards),
                  0.05);
    }
}

// As for a level. A frustum's directions do not see the sphere from below, so an eye at the side misses the largest
// errors.
TEST(SeenError, ReliefErrorIsTwiceTheDistanceToo) {
    constexpr double smaller = 4e-3;
    constexpr int rows = 96;
    const SourceMesh source_mesh = sphere(rows);
    const SourceMesh small_mesh = sphere(rows, smaller);
    const SourceScene source(source_mesh, source_mesh.positions);
    const SourceScene small(small_mesh, small_mesh.positions);
    const std::vector<pack::MeasuredRelief> reliefs{
        {bake_blocks(
             {small,
              glm::dvec3(1.0),
              {pack::ReliefDirection::PlusX, pack::ReliefDirection::MinusX, pack::ReliefDirection::PlusY,
               pack::ReliefDirection::MinusY, pack::ReliefDirection::PlusZ},
              128}),
         {}}};
    const pack::SeenErrors seen = seen_errors(pack_of(sphere(16)), reliefs, source, {});
    ASSERT_EQ(seen.reliefs.size(), 1U);
    ASSERT_EQ(seen.reliefs[0].size(), seen.eyes.size());
    EXPECT_NEAR(static_cast<double>(mean_of(seen.reliefs[0]).mean_box), 2.0 * smaller, 0.5 * smaller);
    for (const pack::SeenError& each : seen.reliefs[0]) {
        EXPECT_GT(static_cast<double>(each.mean_box), 1.3 * smaller);
        EXPECT_LT(static_cast<double>(each.mean_box), 2.8 * smaller);
    }
}

TEST(SeenError, SourceItselfHasOnlyQuantizationError) {
    const SourceMesh mesh = sphere(64);
    const SourceScene source(mesh, mesh.positions);
    const pack::SeenErrors seen = seen_errors(pack_of(mesh), {}, source, {});
    ASSERT_EQ(seen.levels.size(), 1U);
    ASSERT_EQ(seen.levels[0].size(), seen.eyes.size());
    ASSERT_FALSE(seen.eyes.empty());
    for (const pack::SeenError& each : seen.levels[0]) {
        EXPECT_LT(each.mean_box, 2e-5F); // codes are 1.5e-5 apart
        EXPECT_LT(each.silhouette_share, 1e-3F);
    }
}

TEST(SeenError, EyesAreSpreadEvenlyOverTheZone) {
    const SourceMesh mesh = sphere(16);
    const SourceScene source(mesh, mesh.positions);
    const pack::Pack pack = pack_of(mesh);
    glm::dvec3 sum(0.0);
    const pack::SeenErrors around = seen_errors(pack, {}, source, ViewingZone::all_around());
    for (const pack::SeenEye& eye : around.eyes) {
        EXPECT_NEAR(glm::length(eye.towards), 1.0, 1e-12);
        sum += eye.towards;
    }
    EXPECT_LT(glm::length(sum) / static_cast<double>(around.eyes.size()), 0.02);
    for (const pack::SeenEye& eye : seen_errors(pack, {}, source, {}).eyes) {
        EXPECT_GT(eye.towards.z, std::sin(3.0 * std::numbers::pi / 180.0));
    }
}

} // namespace frustumscreen::bake
