#include "app/bench/techniques/closed_mesh.h"

#include <gtest/gtest.h>

namespace frustumscreen::bench {
namespace {

bake::SourceMesh tetrahedron() {
    bake::SourceMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    mesh.triangle_materials = {0, 0, 0, 0};
    mesh.materials = {bake::SourceMaterial{}};
    return mesh;
}

TEST(ClosedMesh, ATetrahedronIsClosed) {
    EXPECT_TRUE(is_closed(tetrahedron()));
}

TEST(ClosedMesh, MergesVerticesSplitAtASeam) {
    bake::SourceMesh mesh = tetrahedron();
    mesh.positions.push_back(mesh.positions[0] + glm::dvec3(1e-12, 0, 0));
    mesh.triangles[1][0] = 4;
    EXPECT_TRUE(is_closed(mesh));
}

TEST(ClosedMesh, RejectsHolesFlippedTrianglesInvertedMeshesAndMasks) {
    bake::SourceMesh hole = tetrahedron();
    hole.triangles.pop_back();
    EXPECT_FALSE(is_closed(hole));
    bake::SourceMesh flipped = tetrahedron();
    std::swap(flipped.triangles[3][0], flipped.triangles[3][1]);
    EXPECT_FALSE(is_closed(flipped));
    bake::SourceMesh inside_out = tetrahedron();
    for (auto& triangle : inside_out.triangles) {
        std::swap(triangle[0], triangle[1]);
    }
    EXPECT_FALSE(is_closed(inside_out));
    bake::SourceMesh masked = tetrahedron();
    masked.materials[0].alpha_mask = true;
    EXPECT_FALSE(is_closed(masked));
}

} // namespace
} // namespace frustumscreen::bench
