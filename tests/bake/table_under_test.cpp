#include "assets_baked/bake/table_under.h"
#include "tests/bake/shapes.h"

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <random>

namespace frustumscreen::bake {
namespace {

using namespace test;

/// A square of the plane z = 0 about the origin, with holes where `has` says no; its triangles lie off by up to `noise`.
template <typename Has>
std::size_t add_ground(SourceMesh& mesh, double side, int cells, double noise, const Has& has) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> off(-noise, noise);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const auto row = static_cast<std::uint32_t>(cells + 1);
    for (int y = 0; y <= cells; ++y) {
        for (int x = 0; x <= cells; ++x) {
            mesh.positions.emplace_back(side * x / cells - side / 2, side * y / cells - side / 2,
                                        off(random));
        }
    }
    const std::size_t before = mesh.triangles.size();
    for (std::uint32_t y = 0; y + 1 < row; ++y) {
        for (std::uint32_t x = 0; x + 1 < row; ++x) {
            const std::uint32_t a = first + y * row + x;
            if (has(0.5 * (mesh.positions[a] + mesh.positions[a + row + 1]))) {
                add_triangle(mesh, a, a + 1, a + row);
                add_triangle(mesh, a + 1, a + row + 1, a + row);
            }
        }
    }
    return mesh.triangles.size() - before;
}

constexpr auto everywhere = [](const glm::dvec3&) { return true; };

/// A ball a little above the plane z = 0, by more than what counts as the plane.
void add_ball(SourceMesh& mesh, double radius) {
    add_sphere(mesh, {0.0, 0.0, 1.05 * radius}, radius, 30);
}

TEST(TableUnder, IsFoundInAnyPositionAndTheObjectStays) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    for (int turn = 0; turn < 12; ++turn) {
        SourceMesh mesh = empty_mesh();
        add_ball(mesh, 0.1);
        const std::size_t ball = mesh.triangles.size();
        const std::size_t table = add_ground(mesh, 0.6, 40, 0.0008, everywhere);
        const glm::dquat rotation =
            glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random)));
        for (glm::dvec3& position : mesh.positions) {
            position = rotation * position + glm::dvec3(7.0, -3.0, 2.0);
        }
        const Scraps found = find_table(mesh, {});
        ASSERT_EQ(found.triangles, table) << turn;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            EXPECT_EQ(found.is_scrap[t], t >= ball) << turn << ": " << t;
        }
        remove_scraps(mesh, found);
        EXPECT_EQ(mesh.triangles.size(), ball);
        EXPECT_EQ(find_table(mesh, {}).triangles, 0U);
    }
}

TEST(TableUnder, IsFoundWithAHoleUnderTheObject) {
    SourceMesh mesh = empty_mesh();
    add_ball(mesh, 0.1);
    const std::size_t table =
        add_ground(mesh, 0.5, 40, 0.0, [](const glm::dvec3& p) { return p.x * p.x + p.y * p.y > 0.0036; });
    EXPECT_EQ(find_table(mesh, {}).triangles, table);
}

TEST(TableUnder, OwnBasesAndFloorsAreKept) {
    SourceMesh plinth = empty_mesh(); // its bottom reaches no farther than its sides
    add_box(plinth, {-0.2, -0.2, 0.0}, {0.2, 0.2, 0.1});
    add_sphere(plinth, {0.0, 0.0, 0.2}, 0.1, 30);
    EXPECT_EQ(find_table(plinth, {}).triangles, 0U);

    SourceMesh book = empty_mesh();
    add_ground(book, 0.3, 10, 0.0, everywhere);
    add_box(book, {-0.15, -0.15, 0.0}, {0.15, 0.15, 0.04});
    EXPECT_EQ(find_table(book, {}).triangles, 0U);

    SourceMesh relief = empty_mesh(); // a figure on its ground, flatter than it is wide
    add_ground(relief, 0.5, 20, 0.0, everywhere);
    add_sphere(relief, {0.0, 0.0, -0.08}, 0.1, 30);
    EXPECT_EQ(find_table(relief, {}).triangles, 0U);

    SourceMesh room = empty_mesh(); // a floor with things on both sides
    add_ground(room, 0.6, 20, 0.0, everywhere);
    add_sphere(room, {0.0, 0.0, 0.12}, 0.1, 30);
    add_sphere(room, {0.0, 0.0, -0.12}, 0.1, 30);
    EXPECT_EQ(find_table(room, {}).triangles, 0U);

    SourceMesh ball = empty_mesh();
    add_ball(ball, 0.1);
    EXPECT_EQ(find_table(ball, {}).triangles, 0U);
}

TEST(TableUnder, MeshWithoutAreaHasNoTable) {
    SourceMesh mesh = empty_mesh();
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    for (int k = 0; k < 200; ++k) {
        add_triangle(mesh, 0, 1, 2);
    }
    EXPECT_EQ(find_table(mesh, {}).triangles, 0U);
}

} // namespace
} // namespace frustumscreen::bake
