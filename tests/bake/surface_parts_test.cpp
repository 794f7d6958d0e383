// Connected parts of hand-made meshes, and what a part of a surface hides.
#include "assets_baked/bake/surface_parts.h"
#include "tests/bake/shapes.h"

#include <gtest/gtest.h>

#include <set>

namespace frustumscreen::bake {

namespace {

/// The parts of the triangles from `first` to before `end`.
std::set<std::uint32_t> parts_in(const SurfaceParts& parts, std::size_t first, std::size_t end) {
    return {parts.part_of.begin() + static_cast<std::ptrdiff_t>(first),
            parts.part_of.begin() + static_cast<std::ptrdiff_t>(end)};
}

SourceMesh boxes(const std::vector<std::pair<glm::dvec3, glm::dvec3>>& corners) {
    SourceMesh mesh = test::empty_mesh();
    for (const auto& [low, high] : corners) {
        test::add_box(mesh, low, high);
    }
    return mesh;
}

constexpr std::size_t box_triangles = 12;

TEST(SurfaceParts, TwoBoxesApartAreTwo) {
    const SourceMesh mesh = boxes({{{0, 0, 0}, {1, 1, 1}}, {{2, 0, 0}, {3, 1, 1}}});
    const SurfaceParts parts = find_parts(mesh, 0.01, 8);
    ASSERT_EQ(parts.count, 2U);
    EXPECT_EQ(parts_in(parts, 0, box_triangles), std::set<std::uint32_t>{0});
    EXPECT_EQ(parts_in(parts, box_triangles, 2 * box_triangles), std::set<std::uint32_t>{1});
}

TEST(SurfaceParts, BoxesThatShareACornerAreOne) {
    // Vertices are not shared, only their positions.
    EXPECT_EQ(find_parts(boxes({{{0, 0, 0}, {1, 1, 1}}, {{1, 1, 1}, {2, 2, 2}}}), 0.01, 8).count, 1U);
    EXPECT_EQ(find_parts(boxes({{{0, 0, 0}, {1, 1, 1}}, {{1, 1, 1.001}, {2, 2, 2}}}), 0.01, 8).count, 2U);
}

TEST(SurfaceParts, ABoxInABoxIsOnePartOfItsOwnUnlessItIsSmall) {
    const SourceMesh mesh = boxes({{{-1, -1, -1}, {1, 1, 1}}, {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}});
    EXPECT_EQ(find_parts(mesh, 0.19, 8).count, 2U); // a fifth of the area
    EXPECT_EQ(find_parts(mesh, 0.21, 8).count, 1U);
}

TEST(SurfaceParts, ASmallPartBelongsToTheNearest) {
    const SourceMesh mesh = boxes({{{0, 0, 0}, {1, 1, 1}},
                                   {{4, 0, 0}, {5, 1, 1}},
                                   {{2.9, 0, 0}, {3, 0.1, 0.1}}, // 1 from the second, 1.9 from the first
                                   {{0.4, 0.4, 0.4}, {0.5, 0.5, 0.5}}}); // within the first
    const SurfaceParts parts = find_parts(mesh, 0.05, 8);
    ASSERT_EQ(parts.count, 2U);
    EXPECT_EQ(parts.part_of[2 * box_triangles], parts.part_of[box_triangles]);
    EXPECT_EQ(parts.part_of[3 * box_triangles], parts.part_of[0]);
}

TEST(SurfaceParts, ASmallPartWithinTwoBoxesBelongsToTheSmaller) {
    const SourceMesh mesh =
        boxes({{{-5, -5, 0}, {5, 5, 1}}, {{-1, -1, 0.1}, {1, 1, 3}}, {{0, 0, 0.5}, {0.1, 0.1, 0.6}}});
    const SurfaceParts parts = find_parts(mesh, 0.02, 8);
    ASSERT_EQ(parts.count, 2U);
    EXPECT_EQ(parts.part_of[2 * box_triangles], parts.part_of[box_triangles]);
}

TEST(SurfaceParts, AChainHasAsManyPartsAsAreAllowed) {
    std::vector<std::pair<glm::dvec3, glm::dvec3>> links;
    for (int k = 0; k < 10; ++k) {
        links.emplace_back(glm::dvec3(2 * k, 0, 0), glm::dvec3(2 * k + 1, 1, 1 + 0.1 * k));
    }
    const SourceMesh mesh = boxes(links);
    EXPECT_EQ(find_parts(mesh, 0.01, 20).count, 10U);
    const SurfaceParts three = find_parts(mesh, 0.01, 3);
    ASSERT_EQ(three.count, 3U);
    // The three largest are the last three, and all others hang on the first of these.
    EXPECT_EQ(parts_in(three, 0, 8 * box_triangles).size(), 1U);
    EXPECT_EQ(find_parts(mesh, 0.5, 20).count, 1U) << "none is large: all are one";
}

TEST(SurfaceParts, SurfacesOfOneNodeAreOnePartAndNodesOfOneSurfaceToo) {
    SourceMesh mesh = boxes({{{0, 0, 0}, {1, 1, 1}},
                             {{2, 0, 0}, {3, 1, 1}},
                             {{4, 0, 0}, {5, 1, 1}},
                             {{5, 1, 1}, {6, 2, 2}}}); // the last two share a corner
    mesh.nodes.resize(3);
    mesh.triangle_nodes.assign(2 * box_triangles, 0);
    mesh.triangle_nodes.resize(3 * box_triangles, 1);
    mesh.triangle_nodes.resize(4 * box_triangles, 2);
    const SurfaceParts parts = find_parts(mesh, 0.01, 8);
    ASSERT_EQ(parts.count, 2U);
    EXPECT_EQ(parts_in(parts, 0, 2 * box_triangles).size(), 1U);
    EXPECT_EQ(parts_in(parts, 2 * box_triangles, 4 * box_triangles).size(), 1U);
}

TEST(SurfaceParts, WhatAnotherPartHidesIsLeftOut) {
    SourceMesh mesh = boxes({{{-1, -1, -1}, {1, 1, 1}}, {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}});
    mesh.default_up = 'z';
    const BoxFrame frame = make_box_frame(mesh, {"z", 0.0, 0.0}).value();
    const SourceMesh made = with_parts(mesh, find_parts(mesh, 0.01, 8), frame, ViewingZone::all_around());
    ASSERT_EQ(made.nodes.size(), 2U);
    EXPECT_EQ(made.triangles.size(), box_triangles) << "nobody sees the inner box";
    EXPECT_EQ(made.triangle_nodes, std::vector<std::uint32_t>(box_triangles, 0));
    EXPECT_EQ(made.triangle_materials.size(), box_triangles);
}

} // namespace

} // namespace frustumscreen::bake
