// More triangles for an unchanged surface.
#include "app/bench/measures/subdivide.h"
#include "tests/bake/shapes.h"

#include <gtest/gtest.h>

namespace frustumscreen::bench {
namespace {

double area_of(const bake::SourceMesh& mesh, std::size_t triangle) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    return 0.5 * glm::length(glm::cross(mesh.positions[b] - mesh.positions[a],
                                        mesh.positions[c] - mesh.positions[a]));
}

TEST(Subdivide, CutsEachTriangleIntoFourOfAQuarterOfItsArea) {
    bake::SourceMesh mesh = test::empty_mesh();
    test::add_box(mesh, {0, 0, 0}, {1, 2, 3});
    for (const glm::dvec3& p : mesh.positions) {
        mesh.uvs.emplace_back(p.x, 2.0 * p.y);
    }
    const bake::SourceMesh fine = subdivide(mesh);
    ASSERT_EQ(fine.triangles.size(), 4 * mesh.triangles.size());
    EXPECT_EQ(fine.triangle_materials.size(), fine.triangles.size());
    for (std::size_t k = 0; k < fine.triangles.size(); ++k) {
        EXPECT_NEAR(area_of(fine, k), 0.25 * area_of(mesh, k / 4), 1e-12);
    }
    ASSERT_EQ(fine.uvs.size(), fine.positions.size());
    for (std::size_t k = 0; k < fine.uvs.size(); ++k) {
        EXPECT_NEAR(static_cast<double>(fine.uvs[k].y), 2.0 * fine.positions[k].y, 1e-6);
    }
    EXPECT_EQ(fine.positions.size(), 8U + 18U) << "neighbours share the middle of their edge";
}

} // namespace
} // namespace frustumscreen::bench
