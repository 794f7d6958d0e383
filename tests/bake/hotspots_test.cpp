// Points on the surface, against spheres and boxes whose surfaces are known.
#include "assets_baked/bake/hotspots.h"
#include "tests/bake/shapes.h"

#include <gtest/gtest.h>

namespace frustumscreen::bake {
namespace {

/// A mesh in its box, with the file's z axis up.
struct InBox {
    explicit InBox(SourceMesh made)
        : mesh(std::move(made)), frame(make_box_frame(mesh, {"z", 0.0, 0.0}).value()),
          points(in_box(mesh, frame)), scene(mesh, points) {}
    [[nodiscard]] Result<pack::PackHotspot> put(const glm::dvec3& point) const {
        return put_on_surface({"hotspots[0].point", point, {{"en", "here"}}}, scene, frame, {});
    }
    SourceMesh mesh;
    BoxFrame frame;
    std::vector<glm::dvec3> points;
    SourceScene scene;
};

SourceMesh sphere(bool inside_out) {
    SourceMesh mesh = test::empty_mesh();
    test::add_sphere(mesh, {5.0, -3.0, 100.0}, 10.0, 96);
    for (auto& triangle : mesh.triangles) {
        if (inside_out) {
            std::swap(triangle[1], triangle[2]);
        }
    }
    return mesh;
}

TEST(Hotspots, lie_on_the_surface_and_look_outward_for_any_winding) {
    for (const bool inside_out : {false, true}) {
        const InBox ball(sphere(inside_out));
        for (const glm::dvec3 direction :
             {glm::dvec3(1, 0, 0), glm::dvec3(0.6, 0, 0.8), glm::dvec3(-0.48, 0.6, 0.64), glm::dvec3(0, 0, 1),
              glm::dvec3(0, -0.8, -0.6)}) {
            for (const double off : {-0.8, 0.0, 0.8}) { // below and above the surface
                const auto hotspot = ball.put(glm::dvec3(5, -3, 100) + (10.0 + off) * direction);
                ASSERT_TRUE(hotspot) << hotspot.error().message;
                const glm::dvec3 expected = glm::dvec3(0, 0, 0.5) + 0.5 * direction; // sphere of the box
                EXPECT_LT(glm::distance(hotspot->point, expected), 2e-3);
                EXPECT_GT(glm::dot(hotspot->normal, direction), std::cos(0.03)) << inside_out << ' ' << off;
                EXPECT_NEAR(glm::length(hotspot->normal), 1.0, 1e-9);
                EXPECT_EQ(hotspot->labels.size(), 1U);
            }
        }
    }
}

TEST(Hotspots, too_far_from_the_surface_are_refused_with_the_nearest_point) {
    const InBox ball(sphere(false));
    EXPECT_TRUE(ball.put({15.9, -3.0, 100.0}));
    const auto far = ball.put({16.2, -3.0, 100.0}); // 1.2, at a size of 20
    ASSERT_FALSE(far);
    EXPECT_EQ(
        far.error().message,
        "hotspots[0].point is [16.2, -3, 100], which is 6.0 % of the artifact's size away from its surface; "
        "allowed are 5 % of that size; the nearest point of it is [15, -3, 100]");
    EXPECT_FALSE(ball.put({5.0, -3.0, 100.0})) << "the middle";
    EXPECT_FALSE(ball.put({1e9, 1e9, -1e9}));
}

TEST(Hotspots, on_hidden_surfaces_are_refused) {
    SourceMesh mesh = test::empty_mesh();
    test::add_box(mesh, {0, 0, 0}, {10, 10, 10});
    test::add_box(mesh, {4, 4, 4}, {6, 6, 6}); // inside the first box
    const InBox boxes(std::move(mesh));
    const auto hidden = boxes.put({5.0, 5.0, 6.0});
    ASSERT_FALSE(hidden);
    EXPECT_EQ(hidden.error().id, "hotspot.hidden") << hidden.error().message;
    EXPECT_FALSE(boxes.put({5.0, 5.0, 0.0})) << "it stands on this side";
    const auto open = boxes.put({5.0, 5.0, 10.0});
    ASSERT_TRUE(open);
    EXPECT_GT(open->normal.z, 0.999);
}

TEST(Hotspots, normal_is_smooth_on_a_noisy_surface) {
    SourceMesh mesh = test::empty_mesh();
    test::add_sphere(mesh, {0, 0, 0}, 10.0, 160);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> noise(-0.03, 0.03); // makes triangles 0.2 wide steep
    for (glm::dvec3& position : mesh.positions) {
        position += glm::dvec3(noise(random), noise(random), noise(random));
    }
    const InBox ball(std::move(mesh));
    for (int k = 0; k < 24; ++k) {
        const glm::dvec3 direction(0.8 * std::cos(k), 0.8 * std::sin(k), 0.6);
        const auto hotspot = ball.put(10.0 * direction);
        ASSERT_TRUE(hotspot);
        EXPECT_GT(glm::dot(hotspot->normal, direction), std::cos(0.12)) << k;
    }
}

} // namespace
} // namespace frustumscreen::bake
