#include "assets_baked/bake/visibility.h"
#include "tests/bake/shapes.h"

#include <gtest/gtest.h>

namespace frustumscreen::bake {

namespace {

TriangleMesh seen_of(const SourceMesh& mesh) {
    const SourceScene scene(mesh, mesh.positions);
    return visible_sides(weld(mesh, mesh.positions), scene, ViewingZone{});
}

} // namespace

TEST(Visibility, BottomAndInsideAreDropped) {
    SourceMesh mesh = test::empty_mesh();
    test::add_box(mesh, {-0.5, -0.5, 0.0}, {0.5, 0.5, 1.0});
    test::add_sphere(mesh, {0, 0, 0.5}, 0.3, 12);
    const TriangleMesh seen = seen_of(mesh);
    // Growing over shared vertices may keep the bottom's two triangles, never the sphere's.
    EXPECT_LE(seen.triangle_count(), 12U);
    EXPECT_GE(seen.triangle_count(), 10U);
}

TEST(Visibility, AnOpenSheetIsSeenFromBothSides) {
    SourceMesh mesh = test::empty_mesh();
    mesh.positions = {{-0.5, 0, 0}, {0.5, 0, 0}, {0.5, 0, 1}, {-0.5, 0, 1}};
    test::add_triangle(mesh, 0, 1, 2);
    test::add_triangle(mesh, 0, 2, 3);
    EXPECT_EQ(seen_of(mesh).triangle_count(), 4U);
}

TEST(Visibility, TheInsideOfACupIsSeenThroughItsMouth) {
    SourceMesh mesh = test::empty_mesh();
    test::add_box(mesh, {-0.5, -0.5, 0.0}, {0.5, 0.5, 0.5});
    mesh.triangles.erase(mesh.triangles.begin() + 8, mesh.triangles.begin() + 10); // the top
    mesh.triangle_materials.resize(mesh.triangles.size());
    // Four walls outside, four walls and the floor inside; growing may add the floor's underside.
    EXPECT_GE(seen_of(mesh).triangle_count(), 18U);
    EXPECT_LE(seen_of(mesh).triangle_count(), 20U);
}

} // namespace frustumscreen::bake
