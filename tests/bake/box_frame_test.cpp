#include "app/geometry/prop_shape.h"
#include "assets_baked/bake/box_frame.h"
#include "tests/bake/shapes.h"

#include <gtest/gtest.h>

#include <random>

namespace frustumscreen::bake {

TEST(BoxFrame, EveryUpAxisTurnsToPlusZWithoutMirroring) {
    const std::vector<std::pair<const char*, glm::dvec3>> axes{{"x", {1, 0, 0}},   {"y", {0, 1, 0}},
                                                               {"z", {0, 0, 1}},   {"-x", {-1, 0, 0}},
                                                               {"-y", {0, -1, 0}}, {"-z", {0, 0, -1}}};
    for (const auto& [name, axis] : axes) {
        const auto rotation = up_rotation(name);
        ASSERT_TRUE(rotation);
        EXPECT_NEAR(glm::determinant(*rotation), 1.0, 1e-15);
        EXPECT_LT(glm::distance(*rotation * axis, glm::dvec3(0, 0, 1)), 1e-15) << name;
    }
    EXPECT_FALSE(up_rotation("up"));
}

TEST(BoxFrame, TheBoxStandsCentredWithLongestEdgeOneAtAnyScaleAndPlace) {
    for (const double scale : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {
        for (const double away : {0.0, 1e6}) {
            SourceMesh mesh = test::empty_mesh();
            const glm::dvec3 corner = glm::dvec3(0.3, -0.7, 0.2) * away * scale;
            test::add_box(mesh, corner, corner + glm::dvec3(2.0, 1.0, 4.0) * scale);
            const auto frame = make_box_frame(mesh, {"z"});
            ASSERT_TRUE(frame);
            EXPECT_NEAR(frame->box_size.x, 0.5, 1e-9);
            EXPECT_NEAR(frame->box_size.y, 0.25, 1e-9);
            EXPECT_NEAR(frame->box_size.z, 1.0, 1e-9);
            for (const glm::dvec3& p : in_box(mesh, *frame)) {
                EXPECT_NEAR(std::abs(p.x), 0.25, 1e-9);
                EXPECT_NEAR(std::abs(p.y), 0.125, 1e-9);
                EXPECT_TRUE(std::abs(p.z) < 1e-9 || std::abs(p.z - 1.0) < 1e-9);
            }
        }
    }
}

TEST(BoxFrame, APointHasNoBox) {
    SourceMesh mesh = test::empty_mesh();
    mesh.positions.assign(3, glm::dvec3(4.0));
    test::add_triangle(mesh, 0, 1, 2);
    const auto frame = make_box_frame(mesh, {"y"});
    ASSERT_FALSE(frame);
    EXPECT_EQ(frame.error().id, "bake.no_extent") << frame.error().message;
}

TEST(BoxFrame, ExtremesGiveTheSameScaleAsAllPoints) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (int round = 0; round < 50; ++round) {
        std::vector<glm::dvec3> points;
        for (int k = 0; k < 500; ++k) {
            points.emplace_back(normal(random), normal(random), std::abs(normal(random)));
        }
        const std::vector<glm::dvec3> extremes = profile_extremes(points);
        EXPECT_LT(extremes.size(), points.size() / 2);
        for (const geometry::PropShape& prop :
             {geometry::make_frustum({}), geometry::make_frustum({0.2, 0.05, 0.3}),
              geometry::make_cube(0.12)}) {
            const double all = geometry::largest_scale_inside(prop, points);
            EXPECT_NEAR(geometry::largest_scale_inside(prop, extremes), all, 1e-12 * all);
        }
    }
}

} // namespace frustumscreen::bake
