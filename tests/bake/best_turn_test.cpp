// The turn of an artifact, compared with the prop's own planes and with plain geometry.

#include "app/geometry/prop_shape.h"
#include "assets_baked/bake/best_turn.h"
#include "assets_baked/bake/box_frame.h"
#include "tests/bake/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace frustumscreen::bake {
namespace {

/// The largest size after a turn, from all vertices of the mesh and the prop's own planes.
double size_after(const SourceMesh& mesh, double turn_deg, double lift = 0.0) {
    const auto frame = make_box_frame(mesh, {"z", turn_deg, lift});
    EXPECT_TRUE(frame);
    return geometry::largest_scale_inside(geometry::make_frustum({}), in_box(mesh, *frame)) /
           frame->file_units_per_box;
}

SourceMesh box(const glm::dvec3& size, double turn_deg = 0.0) {
    SourceMesh mesh = test::empty_mesh();
    test::add_box(mesh, -size / 2.0, size / 2.0);
    for (glm::dvec3& p : mesh.positions) {
        p = turn_rotation(turn_deg) * p + glm::dvec3(3.0, -7.0, 11.0);
    }
    return mesh;
}

/// An upright plate, so thin that it is largest across the prop's diagonal.
TEST(BestTurn, AThinPlateStandsAcrossTheDiagonal) {
    const SourceMesh plate = box({4.0, 1e-4, 1.0});
    const double turn = best_turn_deg(plate, "z", 0.0, geometry::make_frustum({}));
    EXPECT_EQ(std::abs(turn), 45.0);
    EXPECT_GT(size_after(plate, turn), 1.3 * size_after(plate, 0.0));
}

TEST(BestTurn, NoTurnMakesItClearlyLarger) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    for (int round = 0; round < 20; ++round) {
        SourceMesh mesh = test::empty_mesh();
        for (std::uint32_t k = 0; k < 30; ++k) {
            mesh.positions.push_back({u(random) * 2.0, u(random) * u(random), u(random)});
            if (k % 3 == 2) {
                test::add_triangle(mesh, k - 2, k - 1, k);
            }
        }
        const double lift = round % 2 == 0 ? 0.0 : 0.3;
        const double turn = best_turn_deg(mesh, "z", lift, geometry::make_frustum({}));
        const double size = size_after(mesh, turn, lift);
        for (int other = 0; other < 360; ++other) {
            EXPECT_GE(size, 0.9949 * size_after(mesh, other, lift))
                << turn << ", and " << other << " is better";
        }
    }
}

TEST(BestTurn, ARoundArtifactAndACubeAreNotTurned) {
    SourceMesh round = test::empty_mesh();
    constexpr std::uint32_t sides = 180;
    for (std::uint32_t k = 0; k < sides; ++k) {
        const double angle = k * 2.0 * std::numbers::pi / sides;
        round.positions.push_back({std::cos(angle), std::sin(angle), 0.0});
        round.positions.push_back({std::cos(angle), std::sin(angle), 3.0});
    }
    for (std::uint32_t k = 0; k < sides; ++k) {
        const std::uint32_t next = (k + 1) % sides;
        test::add_triangle(round, 2 * k, 2 * next, 2 * k + 1);
        test::add_triangle(round, 2 * next, 2 * next + 1, 2 * k + 1);
    }
    EXPECT_EQ(best_turn_deg(round, "z", 0.0, geometry::make_frustum({})), 0.0);
    EXPECT_EQ(best_turn_deg(box({1, 1, 1}), "z", 0.0, geometry::make_frustum({})), 0.0);
    EXPECT_EQ(best_turn_deg(box({1, 1, 1}), "z", 0.0, geometry::make_cube(0.16)), 0.0);
}

/// The boxes are so high that their height alone limits the size.
TEST(BestTurn, TheBroadSideLooksAtTheVisitorAndAChestStandsStraight) {
    const geometry::PropShape prop = geometry::make_frustum({});
    EXPECT_EQ(best_turn_deg(box({1.0, 0.4, 12.0}), "z", 0.0, prop), 0.0);
    EXPECT_EQ(best_turn_deg(box({0.4, 1.0, 12.0}), "z", 0.0, prop), 90.0);
    EXPECT_EQ(best_turn_deg(box({0.95, 1.0, 12.0}), "z", 0.0, prop), 0.0) << "not clearly broader";
}

TEST(BestTurn, StandingIsIndependentOfTheFilesTurn) {
    for (const double turned : {10.0, 30.0, -20.0}) {
        const SourceMesh plate = box({4.0, 0.01, 1.0}, turned);
        const double turn = best_turn_deg(plate, "z", 0.0, geometry::make_frustum({}));
        EXPECT_NEAR(std::abs(std::remainder(turn + turned, 90.0)), 45.0, 3.0) << turned;
        EXPECT_EQ(turn, best_turn_deg(plate, "z", 0.0, geometry::make_frustum({}))) << "it is deterministic";
    }
}

TEST(BestTurn, ALiftRaisesTheArtifactInItsBox) {
    const SourceMesh mesh = box({1, 2, 3});
    const auto frame = make_box_frame(mesh, {"z", 90.0, 0.5});
    ASSERT_TRUE(frame);
    EXPECT_NEAR(frame->box_size.z, 1.0, 1e-12);
    EXPECT_NEAR(frame->box_size.x, 2.0 / 4.5, 1e-12);
    double lowest = 1e9;
    double highest = -1e9;
    for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
        const glm::dvec3 in_frame = in_box(mesh, *frame)[k];
        const glm::dvec3 by_matrix(frame->box_from_file * glm::dvec4(mesh.positions[k], 1.0));
        EXPECT_LT(glm::distance(in_frame, by_matrix), 1e-12);
        lowest = std::min(lowest, in_frame.z);
        highest = std::max(highest, in_frame.z);
    }
    EXPECT_NEAR(lowest, 1.5 / 4.5, 1e-12);
    EXPECT_NEAR(highest, 1.0, 1e-12);
}

} // namespace
} // namespace frustumscreen::bake
