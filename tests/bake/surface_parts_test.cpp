// Connected parts of hand-made meshes, and what a part of a surface hides.
#include "assets_baked/bake/surface_parts.h"
#include "assets_baked/bake/world_cells.h"
#include "tests/bake/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
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

TEST(SurfaceParts, PartCountIsLimited) {
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

TEST(SurfaceParts, SharedNodesAndSharedSurfacesJoinParts) {
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

TEST(SurfaceParts, HiddenPartsAreOmitted) {
    SourceMesh mesh = boxes({{{-1, -1, -1}, {1, 1, 1}}, {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}});
    mesh.default_up = 'z';
    const BoxFrame frame = make_box_frame(mesh, {"z", 0.0, 0.0}).value();
    const SourceMesh made = with_parts(mesh, find_parts(mesh, 0.01, 8), frame, ViewingZone::all_around());
    ASSERT_EQ(made.nodes.size(), 2U);
    EXPECT_EQ(made.triangles.size(), box_triangles) << "nobody sees the inner box";
    EXPECT_EQ(made.triangle_nodes, std::vector<std::uint32_t>(box_triangles, 0));
    EXPECT_EQ(made.triangle_materials.size(), box_triangles);
}

/// The finest levels of all cells, at rest in the whole's box.
SourceMesh joined_at_rest(const WorldCells& made) {
    SourceMesh all = test::empty_mesh();
    std::vector<world::Cell> tree;
    for (const pack::PackCell& each : made.cells) {
        tree.push_back(each.cell);
    }
    const std::vector<world::CellPose> poses = world::poses_at_rest(tree);
    for (std::size_t k = 0; k < made.cells.size(); ++k) {
        const pack::Pack& pack = made.geometry[k];
        const pack::PackLevel& finest = pack.levels.back();
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        for (const pack::PackVertex& vertex : finest.vertices) {
            const glm::dvec3 share(vertex.position[0], vertex.position[1], vertex.position[2]);
            const glm::dvec3 own = (share / 65535.0 - glm::dvec3(0.5, 0.5, 0.0)) * pack.box_size;
            all.positions.emplace_back(poses[k].box_from_geometry * glm::dvec4(own, 1.0));
        }
        for (std::size_t i = 0; i < finest.indices.size(); i += 3) {
            test::add_triangle(all, first + finest.indices[i], first + finest.indices[i + 1],
                               first + finest.indices[i + 2]);
        }
    }
    return all;
}

TEST(SurfaceParts, EveryRayMeetsTheSameSurfaceInCellsAsInTheWhole) {
    // A ball rests in a ring of boxes on a plate: parts touch, overlap and hide each other.
    SourceMesh mesh = boxes(
        {{{-2, -2, -0.3}, {2, 2, 0}}, {{-1.2, -1, 0}, {-0.8, 1, 0.5}}, {{0.8, -1, -0.1}, {1.2, 1, 0.5}}});
    test::add_sphere(mesh, {0, 0, 0.9}, 0.9, 48);
    mesh.default_up = 'z';
    BakeOptions options;
    options.relief = false;
    options.unlit = true;
    options.size = 64;
    options.measuring = 0.1;
    options.up = "z";
    options.table_picture = false;
    const BoxFrame frame = make_box_frame(mesh, {options.up, options.turn_deg, options.lift}).value();
    const SourceMesh in_parts = with_parts(mesh, find_parts(mesh, 0.01, 8), frame, options.prop.zone);
    ASSERT_EQ(in_parts.nodes.size(), 4U);
    ASSERT_LT(in_parts.triangles.size(), mesh.triangles.size());
    const WorldCells made = bake_cells(in_parts, frame, options, CellSides::SeenAtRest);
    const SourceMesh cells = joined_at_rest(made);
    const std::vector<glm::dvec3> points = in_box(mesh, frame);
    const SourceScene whole(mesh, points);
    const SourceScene drawn(cells, cells.positions, Sides::Front);
    constexpr float step = 2e-3F; // between rays that must agree: no outline lies between them
    std::size_t compared = 0;
    for (int turn = 0; turn < 6; ++turn) {
        const float azimuth = 1.0472F * static_cast<float>(turn) + 0.1F;
        const float height = 0.3F + 0.3F * static_cast<float>(turn);
        const glm::vec3 eye(3.0F * std::cos(azimuth), 3.0F * std::sin(azimuth), height);
        const glm::vec3 across(-std::sin(azimuth), std::cos(azimuth), 0.0F);
        for (int ray = 0; ray < 60 * 60; ++ray) {
            const glm::vec3 at = across * (0.012F * static_cast<float>(ray % 60 - 30) + 0.0007F) +
                                 glm::vec3(0.0F, 0.0F, 0.009F * static_cast<float>(ray / 60) + 0.0011F);
            const auto distance = [&](const SourceScene& scene, const glm::vec3& target) {
                const SurfaceHit hit = scene.trace(eye, glm::normalize(target - eye));
                return hit.hit ? hit.distance : 1e3F;
            };
            const float there = distance(whole, at);
            bool is_smooth = true;
            for (const glm::vec3& beside :
                 {across * step, -across * step, glm::vec3(0, 0, step), glm::vec3(0, 0, -step)}) {
                is_smooth = is_smooth && std::abs(distance(whole, at + beside) - there) < 0.03F;
            }
            if (is_smooth) {
                ASSERT_NEAR(distance(drawn, at), there, 5e-3F) << turn << ' ' << ray;
                compared += there < 1e3F ? 1 : 0;
            }
        }
    }
    EXPECT_GT(compared, 5'000U);
}

} // namespace

} // namespace frustumscreen::bake
