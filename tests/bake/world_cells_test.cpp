// The cells of a world against the whole artifact: each vertex of a cell, posed at rest, is held against the whole's own
// triangles by the nearest point of each.
#include "assets_baked/bake/world_cells.h"
#include "tests/bake/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace frustumscreen::bake {

namespace {

BakeOptions quick() {
    BakeOptions options;
    options.relief = false;
    options.size = 64;
    options.unlit = true;
    options.measuring = 0.1;
    options.up = "y";
    options.turn_deg = 30.0;
    options.lift = 0.1;
    return options;
}

/// Adds a node that has the triangles added since the last one. Their positions are in the file's frame already.
void end_node(SourceMesh& mesh, SourceNode node) {
    mesh.triangle_nodes.resize(mesh.triangles.size(), static_cast<std::uint32_t>(mesh.nodes.size()));
    mesh.nodes.push_back(std::move(node));
}

/// A chest with a lid, and on the lid a knob, in frames of their own that turn, stretch and mirror.
SourceMesh chest() {
    SourceMesh mesh = test::empty_mesh();
    test::add_box(mesh, {-1, 0, -2}, {1, 1, 2});
    world::LocalPose table;
    table.translation = {0.3, -0.2, 0.1};
    table.rotation = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3)));
    end_node(mesh, {.name = "chest", .parent = {}, .parent_from_base = glm::dmat4(2.0), .rest = table});
    mesh.nodes.back().parent_from_base[3] = glm::dvec4(5, 6, 7, 1);
    test::add_box(mesh, {-1, 1.01, -2}, {1, 1.2, 2});
    world::LocalPose hinge;
    hinge.translation = {1, 1, 0};
    hinge.scale = {1, -3, 0.5};
    end_node(mesh, {.name = "lid", .parent = 0, .parent_from_base = glm::dmat4(1.0), .rest = hinge});
    test::add_sphere(mesh, {0, 1.4, 0}, 0.2, 16);
    end_node(mesh, {.name = "knob", .parent = 1, .parent_from_base = glm::dmat4(1.0), .rest = hinge});
    return mesh;
}

BoxFrame frame_of(const SourceMesh& mesh, const BakeOptions& options) {
    return make_box_frame(mesh, {options.up, options.turn_deg, options.lift}).value();
}

/// As pack.h has it: codes over the box, which is centred on the z axis and stands on z = 0.
glm::dvec3 decoded(const pack::PackVertex& vertex, const glm::dvec3& box_size) {
    const glm::dvec3 share(vertex.position[0] / 65535.0, vertex.position[1] / 65535.0,
                           vertex.position[2] / 65535.0);
    return (share - glm::dvec3(0.5, 0.5, 0.0)) * box_size;
}

double distance_to(const SourceMesh& mesh, const std::vector<glm::dvec3>& points, const glm::dvec3& from) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : mesh.triangles) {
        // The nearest point by projecting onto the plane, the three edges and corners.
        const glm::dvec3 corners[3] = {points[a], points[b], points[c]};
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 edge = corners[(k + 1) % 3] - corners[k];
            const double along =
                std::clamp(glm::dot(from - corners[k], edge) / glm::dot(edge, edge), 0.0, 1.0);
            nearest = std::min(nearest, glm::length(from - corners[k] - along * edge));
        }
        const glm::dvec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        bool inside = true;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 edge = corners[(k + 1) % 3] - corners[k];
            inside = inside && glm::dot(glm::cross(edge, from - corners[k]), across) >= 0.0;
        }
        if (inside) {
            nearest = std::min(nearest, std::abs(glm::dot(from - corners[0], glm::normalize(across))));
        }
    }
    return nearest;
}

std::vector<world::CellPose> poses_of(const WorldCells& made) {
    std::vector<world::Cell> cells;
    for (const pack::PackCell& each : made.cells) {
        cells.push_back(each.cell);
    }
    return world::poses_at_rest(cells);
}

TEST(WorldCells, AtRestEachCellLiesOnTheWholesSurface) {
    const SourceMesh mesh = chest();
    const BakeOptions options = quick();
    const BoxFrame frame = frame_of(mesh, options);
    const WorldCells made = bake_cells(mesh, frame, options);
    ASSERT_EQ(made.cells.size(), 3U);
    ASSERT_EQ(made.geometry.size(), 3U);
    EXPECT_TRUE(made.notes.empty());
    const std::vector<glm::dvec3> points = in_box(mesh, frame);
    const std::vector<world::CellPose> poses = poses_of(made);
    std::size_t compared = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_TRUE(made.cells[k].cell.has_geometry);
        for (int column = 0; column < 4; ++column) {
            EXPECT_EQ(made.cells[k].cell.cell_from_geometry[column].w, column == 3 ? 1.0 : 0.0) << "affine";
        }
        const pack::Pack& pack = made.geometry[k];
        ASSERT_FALSE(pack.levels.empty());
        const pack::PackLevel& finest = *std::max_element(
            pack.levels.begin(), pack.levels.end(), [](const pack::PackLevel& a, const pack::PackLevel& b) {
                return a.indices.size() < b.indices.size();
            });
        const glm::dmat4& box_from_geometry = poses[k].box_from_geometry;
        const double stretch = glm::length(glm::dvec3(box_from_geometry[0]));
        const double longest =
            std::max({made.cells[k].high.x - made.cells[k].low.x, made.cells[k].high.y - made.cells[k].low.y,
                      made.cells[k].high.z - made.cells[k].low.z});
        EXPECT_NEAR(stretch, longest, 1e-12) << "the longest edge of the cell's box is 1";
        const double allowed = stretch * (static_cast<double>(finest.error.max_box) + 2.0 / 65535.0);
        EXPECT_LT(allowed, 1e-3);
        for (const pack::PackVertex& vertex : finest.vertices) {
            const glm::dvec3 at(box_from_geometry * glm::dvec4(decoded(vertex, pack.box_size), 1.0));
            ASSERT_LE(distance_to(mesh, points, at), allowed) << k;
            for (int axis = 0; axis < 3; ++axis) {
                ASSERT_GE(at[axis], made.cells[k].low[axis] - allowed);
                ASSERT_LE(at[axis], made.cells[k].high[axis] + allowed);
            }
            ++compared;
        }
    }
    EXPECT_GT(compared, 300U);
    EXPECT_EQ(made.cells[0].triangles + made.cells[1].triangles + made.cells[2].triangles,
              mesh.triangles.size());
}

TEST(WorldCells, HaveTexelsAsLargeAsTheWholes) {
    const SourceMesh mesh = chest();
    const BakeOptions options = quick();
    const WorldCells made = bake_cells(mesh, frame_of(mesh, options), options);
    EXPECT_EQ(made.geometry[0].relief_size, 64) << "as long as the whole";
    EXPECT_EQ(made.geometry[2].relief_size, 16) << "0.4 of 4 are 7 texels, and no pack has fewer than 16";
    for (const pack::Pack& pack : made.geometry) {
        EXPECT_TRUE(pack.table_picture.texels.empty());
    }
}

TEST(WorldCells, ACellKeepsTheSideThatItRestsOn) {
    SourceMesh mesh = test::empty_mesh();
    test::add_box(mesh, {0, 0, 0}, {1, 1, 1});
    end_node(mesh, {.name = "box", .parent = {}, .parent_from_base = glm::dmat4(1.0), .rest = {}});
    // A sheet whose front looks down: the whole's bake would keep its back alone.
    mesh.positions.insert(mesh.positions.end(), {{2, 0, 0}, {3, 0, 0}, {2, 1, 0}});
    test::add_triangle(mesh, 8, 10, 9);
    end_node(mesh, {.name = "sheet", .parent = {}, .parent_from_base = glm::dmat4(1.0), .rest = {}});
    BakeOptions options = quick();
    options.up = "z";
    options.lift = 0.0;
    const WorldCells made = bake_cells(mesh, frame_of(mesh, options), options);
    const pack::PackLevel& level = made.geometry[1].levels.front();
    const glm::dvec3 size(1.0);
    std::size_t down = 0;
    for (std::size_t k = 0; k + 2 < level.indices.size(); k += 3) {
        const auto corner = [&](std::size_t i) {
            return decoded(level.vertices[level.indices[k + i]], size);
        };
        down += glm::cross(corner(1) - corner(0), corner(2) - corner(0)).z < 0.0 ? 1 : 0;
    }
    EXPECT_EQ(down, 1U);
}

TEST(WorldCells, AFlattenedNodeIsNoCellAndKeepsItsTriangles) {
    SourceMesh mesh = chest();
    mesh.nodes[1].rest.scale.y = 0.0;
    const WorldCells made = bake_cells(mesh, frame_of(mesh, quick()), quick());
    ASSERT_EQ(made.cells.size(), 1U);
    EXPECT_EQ(made.cells[0].triangles, mesh.triangles.size());
    EXPECT_TRUE(made.cell_of[0] && !made.cell_of[1] && !made.cell_of[2]);
    ASSERT_EQ(made.notes.size(), 1U);
    EXPECT_NE(made.notes[0].text.find("(lid, knob)"), std::string::npos) << made.notes[0].text;
}

TEST(WorldCells, ACellWithoutExtentHasNoGeometry) {
    SourceMesh mesh = chest();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (mesh.triangle_nodes[t] == 2) {
            mesh.triangles[t] = {20, 20, 20}; // all at one corner
        }
    }
    const WorldCells made = bake_cells(mesh, frame_of(mesh, quick()), quick());
    ASSERT_EQ(made.cells.size(), 3U);
    EXPECT_FALSE(made.cells[2].cell.has_geometry);
    EXPECT_EQ(made.cells[2].triangles, 0U);
    ASSERT_EQ(made.notes.size(), 1U);
    EXPECT_NE(made.notes[0].text.find("(knob)"), std::string::npos);
}

TEST(WorldCells, ProgressNeverGoesBack) {
    BakeOptions options = quick();
    double last = 0.0;
    int calls = 0;
    options.progress = [&](std::string_view, double done) {
        EXPECT_GE(done, last);
        EXPECT_LE(done, 1.0);
        last = done;
        ++calls;
    };
    const SourceMesh mesh = chest();
    (void)bake_cells(mesh, frame_of(mesh, options), options);
    EXPECT_EQ(last, 1.0);
    EXPECT_GT(calls, 10);
}

TEST(WorldCells, RoundTripThroughAPack) {
    const SourceMesh mesh = chest();
    const BakeOptions options = quick();
    pack::Pack whole = bake(mesh, options).value();
    const WorldCells made = bake_cells(mesh, frame_of(mesh, options), options);
    pack::PackWorld world{.cells = made.cells, .behaviours = {}};
    const Result<void> put = pack::put_world(whole, world, made.geometry);
    ASSERT_TRUE(put) << put.error().message;
    const Result<pack::PackWorld> read = pack::world_of(whole);
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->cells.size(), 3U);
    EXPECT_EQ(read->cells[2].cell, made.cells[2].cell);
    EXPECT_TRUE(pack::check_world(whole));
}

} // namespace

} // namespace frustumscreen::bake
