// Blades on a body: thin parts have hardly any area, but a visitor sees immediately if one is cut off.
#include "app/pack/pack_file.h"
#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/level.h"
#include "assets_baked/bake/simplify.h"
#include "tests/bake/shapes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <span>

namespace frustumscreen::bake {

namespace {

constexpr double body_radius = 0.2;
constexpr double blade_end = 0.5;
/// Widths for an artifact 100 mm long: 0.5, 1 and 2 mm.
constexpr std::array<double, 3> widths{0.005, 0.01, 0.02};

double height_of(std::size_t blade) {
    return 0.15 + 0.05 * static_cast<double>(blade);
}

/// A closed blade along +X with a diamond-shaped section, tapered over its last third to a tip.
void add_blade(SourceMesh& mesh, double width, double height, double end) {
    constexpr int steps = 90;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int k = 0; k <= steps; ++k) {
        const double along = static_cast<double>(k) / steps;
        const double x = 0.1 + (end - 0.1) * along;
        const double half = 0.5 * width * std::fmin(1.0, 3.0 * (1.0 - along) + 0.02);
        for (const auto& [y, z] :
             {std::pair(0.0, half), {0.15 * half, 0.0}, {0.0, -half}, {-0.15 * half, 0.0}}) {
            mesh.positions.emplace_back(x, y, height + z);
        }
    }
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        test::add_triangle(mesh, first + a, first + b, first + c);
        test::add_triangle(mesh, first + a, first + c, first + d);
    };
    for (std::uint32_t k = 0; k < steps; ++k) {
        for (std::uint32_t side = 0; side < 4; ++side) {
            const std::uint32_t next = (side + 1) % 4;
            quad(4 * k + side, 4 * k + next, 4 * (k + 1) + next, 4 * (k + 1) + side);
        }
    }
    quad(0, 3, 2, 1);
    quad(4 * steps, 4 * steps + 1, 4 * steps + 2, 4 * steps + 3);
}

SourceMesh body_with_blades(double end) {
    SourceMesh mesh = test::empty_mesh();
    test::add_sphere(mesh, {0.0, 0.0, body_radius}, body_radius, 128);
    for (std::size_t k = 0; k < widths.size(); ++k) {
        add_blade(mesh, widths[k], height_of(k), end);
    }
    mesh.positions.emplace_back(-0.5, 0.0, 0.1); // the opposite end of the box
    mesh.positions.emplace_back(-0.4, 0.0, 0.1);
    mesh.positions.emplace_back(-0.4, 0.1, 0.1);
    const auto last = static_cast<std::uint32_t>(mesh.positions.size());
    test::add_triangle(mesh, last - 3, last - 2, last - 1);
    return mesh;
}

/// The triangles that face this way, which alone are drawn. A flat blade has two sides at one place.
TriangleMesh facing(const TriangleMesh& mesh, const glm::vec3& towards) {
    TriangleMesh result{mesh.positions, {}};
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        if (glm::dot(mesh.area_normal(t), towards) > 0.0F) {
            const auto corners = std::span(mesh.indices).subspan(3 * t, 3);
            result.indices.insert(result.indices.end(), corners.begin(), corners.end());
        }
    }
    return result;
}

/// Distance from the body's centre, box units, to the last point of the blade that rays from this side hit.
double reach_of(const TriangleMesh& mesh, std::size_t blade, const glm::vec3& towards) {
    const TriangleMesh seen = facing(mesh, towards);
    const SourceMesh seen_mesh = as_source(seen);
    const std::vector<glm::dvec3> points(seen.positions.begin(), seen.positions.end());
    const SourceScene scene(seen_mesh, points);
    constexpr double step = 0.0005;
    double last = 0.0;
    for (double x = 0.25; x < 0.51; x += step) {
        for (double offset = -widths[blade]; offset <= widths[blade]; offset += widths[blade] / 40.0) {
            const glm::vec3 at(x, 0.0, height_of(blade) + offset);
            if (scene.trace(at + towards * 2.0F, -towards).hit) {
                last = x;
            }
        }
    }
    return last;
}

} // namespace

TEST(ThinParts, BladesLoseAtMostAMillimetreOnTheDefaultLevel) {
    const SourceMesh mesh = body_with_blades(blade_end);
    BakeOptions options;
    options.relief = false;
    options.size = 64;
    options.unlit = true;
    options.up = "z";
    const Result<pack::Pack> pack = bake(mesh, options);
    ASSERT_TRUE(pack) << pack.error().message;
    const pack::PackLevel& level = pack->levels[pack->default_level];
    EXPECT_LT(level.indices.size() / 3, mesh.triangles.size() / 2);
    const double mm_per_box = 1e3 * pack::place(*pack, options.prop.shape).metres_per_box;
    EXPECT_LE(static_cast<double>(level.error.max_box) * mm_per_box, 1.0);

    std::vector<glm::dvec3> points;
    for (const glm::dvec3& p : mesh.positions) {
        points.emplace_back(pack->box_from_file * glm::dvec4(p, 1.0));
    }
    const TriangleMesh source = weld(mesh, points);
    const TriangleMesh surface = surface_of(level, pack->box_size);
    for (std::size_t blade = 0; blade < widths.size(); ++blade) {
        for (const glm::vec3& towards : {glm::vec3(0.0F, 0.96F, 0.28F), glm::vec3(0.0F, -0.8F, 0.6F)}) {
            const double whole = reach_of(source, blade, towards);
            ASSERT_GT(whole, 0.45);
            EXPECT_GT(reach_of(surface, blade, towards), whole - 1.0 / mm_per_box) << blade;
        }
    }
}

TEST(ThinParts, ALevelOffByMoreThanAMillimetreIsNotGoodEnough) {
    const double mm_per_box = 100.0;
    const pack::SeenError seen{1e-5F, 1e-4F, 1e-5F, 1e-4F};
    EXPECT_TRUE(good_enough({1e-5F, 1e-4F, 0.0099F, 0.0F}, seen, mm_per_box));
    EXPECT_FALSE(good_enough({1e-5F, 1e-4F, 0.0101F, 0.0F}, seen, mm_per_box));
    EXPECT_FALSE(good_enough({1e-5F, 1e-4F, 0.0F, 0.0F}, {1e-3F, 1e-3F, 1e-5F, 1e-4F}, mm_per_box));
}

TEST(ThinParts, TheSimplifierKeepsEveryCornerWithinItsTolerances) {
    const SourceMesh mesh = body_with_blades(blade_end);
    const TriangleMesh whole = weld(mesh, mesh.positions);
    for (const float tolerance : {1e-3F, 2e-3F}) {
        const TriangleMesh fewer = simplify(whole, tolerance);
        EXPECT_LT(fewer.triangle_count(), whole.triangle_count() / 8);
        const SourceMesh fewer_mesh = as_source(fewer);
        const std::vector<glm::dvec3> points(fewer.positions.begin(), fewer.positions.end());
        const SourceScene scene(fewer_mesh, points);
        for (const glm::vec3& p : whole.positions) {
            ASSERT_TRUE(scene.nearest(p, max_tolerances_lost * tolerance + 1e-6F).hit)
                << p.x << ' ' << p.y << ' ' << p.z;
        }
    }
}

TEST(ThinParts, MaxErrorDetectsACutBlade) {
    const SourceMesh mesh = body_with_blades(blade_end);
    const SourceScene source(mesh, mesh.positions);
    const SourceSamples samples = sample_source(source, weld(mesh, mesh.positions), 1e-3F);
    const SourceMesh cut = body_with_blades(blade_end - 0.1);
    const pack::LevelError error = measure_shape(weld(cut, cut.positions), source, samples);
    EXPECT_NEAR(error.max_box, 0.1, 1e-3);
    EXPECT_LT(error.mean_box, 1e-3); // the mean does not show a lost blade
}

} // namespace frustumscreen::bake
