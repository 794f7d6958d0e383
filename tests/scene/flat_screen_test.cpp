// A flat screen against plain geometry: a pixel's place is its share of the way along the two sides of the rectangle.
#include "app/scene/flat_screen.h"
#include "app/scene/frame_plan.h"

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

namespace frustumscreen::scene {
namespace {

using Corners = std::array<glm::dvec3, 4>;

/// A rectangle around `middle`, turned; top left, top right, bottom right, bottom left.
Corners rectangle(const glm::dvec3& middle, const glm::dvec2& size_m, const glm::dquat& turn) {
    Corners corners{};
    const std::array<glm::dvec2, 4> sides{{{-0.5, 0.5}, {0.5, 0.5}, {0.5, -0.5}, {-0.5, -0.5}}};
    for (std::size_t k = 0; k < corners.size(); ++k) {
        corners[k] = middle + turn * glm::dvec3(sides[k].x * size_m.x, 0.0, sides[k].y * size_m.y);
    }
    return corners;
}
glm::dvec3 place_of(const Corners& corners, const glm::dvec2& share) {
    return corners[0] + share.x * (corners[1] - corners[0]) + share.y * (corners[3] - corners[0]);
}
glm::dvec2 pixel_of(const FlatScreen& screen, const glm::dvec3& table_point) {
    const auto pixel = screen.pinhole.pixel(screen.table_from_pinhole.inverse().point(table_point));
    EXPECT_TRUE(pixel);
    return pixel.value_or(glm::dvec2(NAN));
}

struct Case {
    Corners corners{};
    int width = 0;
    int height = 0;
};
std::vector<Case> cases() {
    std::vector<Case> all;
    const glm::dvec3 middle(0.1, 0.7, 0.5);
    for (const glm::dquat& turn :
         {glm::dquat(1, 0, 0, 0), glm::angleAxis(-0.4, glm::dvec3(1, 0, 0)),
          glm::angleAxis(0.7, glm::dvec3(0, 0, 1)), glm::angleAxis(0.3, glm::dvec3(0, 1, 0)),
          glm::angleAxis(std::numbers::pi, glm::dvec3(0, 1, 0)),
          glm::normalize(glm::dquat(0.7, -0.4, 0.5, 0.3))}) {
        all.push_back({rectangle(middle, {1.2, 0.675}, turn), 1920, 1080});
        all.push_back({rectangle(middle, {0.675, 1.2}, turn), 1080, 1920});
        all.push_back({rectangle(middle, {0.05, 0.05}, turn), 4096, 64}); // of pixels that are no squares
        all.push_back({rectangle(10.0 * middle, {20.0, 10.0}, turn), 64, 8191});
    }
    return all;
}

TEST(FlatScreen, MapsEachPointOfItsRectangleToThePixelThatLightsIt) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    double worst_px = 0.0;
    double worst_m = 0.0;
    for (const Case& each : cases()) {
        const FlatScreen screen = flat_screen(each.corners, each.width, each.height);
        const glm::dvec2 size(each.width, each.height);
        for (int k = 0; k < 100; ++k) {
            // The corners first.
            const glm::dvec2 at = k < 4 ? glm::dvec2(k % 2, k / 2) : glm::dvec2(share(random), share(random));
            const glm::dvec3 place = place_of(each.corners, at);
            worst_px = std::fmax(worst_px, glm::distance(pixel_of(screen, place), at * size));
            // And back: where the pixel's ray meets the surface's plane.
            const glm::dvec3 lens = screen.table_from_pinhole.translation;
            const glm::dvec3 ray = screen.table_from_pinhole.rotation * screen.pinhole.ray(at * size);
            const geometry::Plane& plane = screen.surface.faces.front().plane;
            const glm::dvec3 met = lens - plane.distance(lens) / glm::dot(plane.normal, ray) * ray;
            worst_m = std::fmax(worst_m, glm::distance(met, place));
        }
    }
    EXPECT_LT(worst_px, 1e-9);
    EXPECT_LT(worst_m, 1e-9);
}

TEST(FlatScreen, HasOneFaceTowardsTheFront) {
    for (const Case& each : cases()) {
        const FlatScreen screen = flat_screen(each.corners, each.width, each.height);
        ASSERT_EQ(screen.surface.faces.size(), 1U);
        const geometry::PropFace& face = screen.surface.faces.front();
        EXPECT_NEAR(glm::length(face.plane.normal), 1.0, 1e-15);
        ASSERT_EQ(face.corners.size(), 4U);
        // Counter-clockwise seen from the front, as a prop's faces.
        EXPECT_GT(glm::dot(glm::cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]),
                           face.plane.normal),
                  0.0);
        for (std::size_t k = 0; k < 4; ++k) {
            EXPECT_LT(std::fabs(face.plane.distance(face.corners[k])), 1e-12);
        }
        const glm::dvec3 front =
            glm::cross(each.corners[3] - each.corners[0], each.corners[1] - each.corners[0]);
        EXPECT_GT(glm::dot(front, face.plane.normal), 0.0);
        EXPECT_GT(face.plane.distance(screen.table_from_pinhole.translation), 0.0);
    }
}

/// Corners measured to a millimetre make a rectangle that is nowhere farther off than they are.
TEST(FlatScreen, FitsARectangleToMeasuredCorners) {
    std::mt19937 random(21);
    std::uniform_real_distribution<double> error_m(-0.001, 0.001);
    for (int k = 0; k < 200; ++k) {
        Corners measured =
            rectangle({0.1, 0.7, 0.5}, {1.2, 0.675}, glm::normalize(glm::dquat(0.9, -0.2, 0.1, 0.1)));
        for (glm::dvec3& corner : measured) {
            corner += glm::dvec3(error_m(random), error_m(random), error_m(random));
        }
        const FlatScreen screen = flat_screen(measured, 1920, 1080);
        const auto& corners =
            screen.surface.faces.front().corners; // from the bottom left, counter-clockwise or not
        Corners found{};
        for (std::size_t which = 0; which < 4; ++which) {
            double nearest = 1.0;
            for (std::size_t other = 0; other < 4; ++other) {
                nearest = std::fmin(nearest, glm::distance(measured[which], corners[other]));
                found[which] =
                    glm::distance(measured[which], corners[other]) == nearest ? corners[other] : found[which];
            }
            EXPECT_LT(nearest, 0.003);
        }
        EXPECT_NEAR(glm::dot(found[1] - found[0], found[3] - found[0]), 0.0, 1e-12);
        EXPECT_NEAR(glm::distance(found[0], found[2]), glm::distance(found[1], found[3]), 1e-12);
        const glm::dvec2 size(1920, 1080);
        const std::array<glm::dvec2, 4> pictures{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
        for (std::size_t which = 0; which < 4; ++which) {
            EXPECT_LT(glm::distance(pixel_of(screen, found[which]), pictures[which] * size), 1e-9);
        }
    }
}

/// A tetrahedron that fills a box of 1 m, scaled and placed.
Part solid_at(const glm::dvec3& place_m, double size_m, int samples) {
    pack::PackLevel level;
    for (const auto& [x, y, z] : {std::array{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}}) {
        level.vertices.push_back(
            {{static_cast<std::uint16_t>(65535 * x), static_cast<std::uint16_t>(65535 * y),
              static_cast<std::uint16_t>(65535 * z)},
             0,
             {}});
    }
    level.indices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3, 0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2}; // both sides
    pack::PackCluster all;
    all.index_count = static_cast<std::uint32_t>(level.indices.size());
    all.centre = {0.0F, 0.0F, 0.5F};
    all.radius = 0.87F;
    level.clusters = {all};
    PlacedLevel placed{.triangles = std::make_shared<LevelTriangles>(triangles_of(level, glm::dvec3(1.0))),
                       .box_size = glm::dvec3(1.0),
                       .metres_per_box = size_m,
                       .drawable = {MeshId{1}, {TextureId{2}}},
                       .samples = samples};
    placed.prop_from_placed[3] = glm::dvec4(place_m, 1.0);
    return {std::move(placed), std::nullopt};
}

/// However deep in the room the objects are: the screen's pixels are as many, and so are their samples.
TEST(FlatScreen, TakesTheSamplesThatWereAskedForAtAnyDepth) {
    const FlatScreen screen =
        flat_screen(rectangle({0.0, 0.7, 0.5}, {1.2, 0.675}, glm::dquat(1, 0, 0, 0)), 1920, 1080);
    for (const double eye_y : {-2.0, 0.0, 0.4, 0.6}) {
        for (const double depth_m : {0.05, 0.1, 0.65, 0.75, 1.0, 3.0, 10.0, 90.0}) {
            const glm::dvec3 eye(0.0, eye_y, 0.5);
            if (depth_m < eye_y + 0.05) {
                continue;
            }
            const Part part = solid_at({0.0, depth_m, 0.5}, 0.03, 2);
            FramePlan plan = make_plan(screen.surface, part.level);
            plan_frame(screen.surface, std::span(&part, 1),
                       {.projector = screen.pinhole,
                        .table_from_projector = screen.table_from_pinhole,
                        .table_from_prop = {},
                        .eyes_m = {&eye, 1}},
                       plan);
            ASSERT_EQ(plan.draws.size(), 1U) << eye_y << ' ' << depth_m;
            EXPECT_EQ(plan.samples, 2) << eye_y << ' ' << depth_m;
        }
    }
}

} // namespace
} // namespace frustumscreen::scene
