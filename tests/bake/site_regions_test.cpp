// A site that is cut into regions: areas, edges and squares by arithmetic of the test's own.
#include "assets_baked/bake/level.h"
#include "assets_baked/bake/site_regions.h"
#include "assets_baked/bake/world_cells.h"
#include "tests/bake/shapes.h"
#include "tests/base/told.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace frustumscreen::bake {
namespace {

/// Hills of n x n quads over 200 x 160 m, z up, with texture coordinates that are the place; and a large plate of two
/// triangles under all of it.
SourceMesh hills(int n) {
    SourceMesh mesh = test::empty_mesh();
    mesh.default_up = 'z';
    const auto vertex = [&](double x, double y, double z) {
        mesh.positions.emplace_back(x, y, z);
        mesh.uvs.emplace_back(static_cast<float>(x / 200.0), static_cast<float>(y / 160.0));
        mesh.colours.emplace_back(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), 1.0F);
    };
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            const double x = 200.0 * i / n;
            const double y = 160.0 * j / n;
            vertex(x, y, 10.0 + 8.0 * std::sin(0.05 * x) * std::cos(0.07 * y));
        }
    }
    const auto at = [n](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            test::add_triangle(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1));
            test::add_triangle(mesh, at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    vertex(0, 0, 0);
    vertex(200, 0, 0);
    vertex(200, 160, 0);
    vertex(0, 160, 0);
    test::add_triangle(mesh, first, first + 1, first + 2);
    test::add_triangle(mesh, first, first + 2, first + 3);
    return mesh;
}

BoxFrame site_frame(const SourceMesh& mesh) {
    return make_box_frame(mesh, {"z", 0.0, 0.0}).value();
}

double area_of(const SourceMesh& mesh) {
    double area = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        area += 0.5 * glm::length(glm::cross(mesh.positions[b] - mesh.positions[a],
                                             mesh.positions[c] - mesh.positions[a]));
    }
    return area;
}

TEST(CutSite, KeepsTheSurfaceAndPutsEachPieceIntoOneSquare) {
    const SourceMesh whole = hills(50); // 12.5 quads a square: lines cut triangles
    const BoxFrame frame = site_frame(whole);
    const SourceMesh cut = cut_site(whole, frame, {.max_triangles = 500}).value();
    EXPECT_NEAR(area_of(cut), area_of(whole), 1e-9 * area_of(whole));
    ASSERT_EQ(cut.triangle_nodes.size(), cut.triangles.size());
    ASSERT_EQ(cut.triangle_materials.size(), cut.triangles.size());
    ASSERT_EQ(cut.uvs.size(), cut.positions.size());
    ASSERT_EQ(cut.colours.size(), cut.positions.size());
    EXPECT_GT(cut.triangles.size(), whole.triangles.size());
    std::vector<glm::dvec2> low(cut.nodes.size(), glm::dvec2(1.0)), high(cut.nodes.size(), glm::dvec2(-1.0));
    std::vector<std::size_t> count(cut.nodes.size(), 0);
    const std::vector<glm::dvec3> points = in_box(cut, frame);
    for (std::size_t t = 0; t < cut.triangles.size(); ++t) {
        const std::uint32_t region = cut.triangle_nodes[t];
        ++count[region];
        for (const std::uint32_t v : cut.triangles[t]) {
            low[region] = glm::min(low[region], glm::dvec2(points[v]));
            high[region] = glm::max(high[region], glm::dvec2(points[v]));
        }
    }
    for (std::size_t region = 0; region < cut.nodes.size(); ++region) {
        EXPECT_LE(count[region], 500U) << region;
        EXPECT_GE(count[region], 64U) << region;
        // A square of a quadtree over -0.5 .. 0.5: with a side of 2^-k, it lies between two multiples of that.
        const glm::dvec2 size = high[region] - low[region];
        const double side = std::exp2(std::ceil(std::log2(std::max(size.x, size.y)) - 1e-6));
        EXPECT_GE(side, 1.0 / 16.0);
        EXPECT_LE(side, 0.25);
        for (int axis = 0; axis < 2; ++axis) {
            const double cell = std::floor((low[region][axis] + 0.5) / side + 1e-6);
            EXPECT_LE(high[region][axis], -0.5 + (cell + 1.0) * side + 1e-6) << region;
        }
        for (std::size_t other = 0; other < region; ++other) {
            const glm::dvec2 common = glm::min(high[region], high[other]) - glm::max(low[region], low[other]);
            EXPECT_TRUE(common.x < 1e-6 || common.y < 1e-6) << region << " " << other;
        }
    }
}

/// Each edge inside of the terrain has a neighbour that runs the other way, by its places: no gap opens where it is cut.
TEST(CutSite, OpensNoGap) {
    const SourceMesh whole = hills(50);
    const SourceMesh cut = cut_site(whole, site_frame(whole), {.max_triangles = 500}).value();
    using Place = std::array<double, 3>;
    const auto place = [&](std::uint32_t v) {
        const glm::dvec3& p = cut.positions[v];
        return Place{p.x, p.y, p.z};
    };
    std::map<std::pair<Place, Place>, int> edges;
    for (const auto& triangle : cut.triangles) {
        for (std::size_t c = 0; c < 3; ++c) {
            ++edges[{place(triangle[c]), place(triangle[(c + 1) % 3])}];
        }
    }
    const auto on_border = [](const Place& a, const Place& b) {
        const auto both = [&](int axis, double at) {
            const auto k = static_cast<std::size_t>(axis);
            return std::abs(a[k] - at) < 1e-6 && std::abs(b[k] - at) < 1e-6;
        };
        return both(0, 0.0) || both(0, 200.0) || both(1, 0.0) || both(1, 160.0);
    };
    int inside = 0;
    for (const auto& [edge, times] : edges) {
        EXPECT_EQ(times, 1);
        if (!on_border(edge.first, edge.second)) {
            EXPECT_EQ(edges.count({edge.second, edge.first}), 1U);
            ++inside;
        }
    }
    EXPECT_GT(inside, 10'000);
}

TEST(CutSite, InterpolatesAttributesAtNewCorners) {
    const SourceMesh whole = hills(50);
    const SourceMesh cut = cut_site(whole, site_frame(whole), {.max_triangles = 500}).value();
    ASSERT_GT(cut.positions.size(), whole.positions.size());
    for (std::size_t v = whole.positions.size(); v < cut.positions.size(); ++v) {
        const glm::dvec3& at = cut.positions[v];
        EXPECT_NEAR(static_cast<double>(cut.uvs[v].x), at.x / 200.0, 1e-6);
        EXPECT_NEAR(static_cast<double>(cut.uvs[v].y), at.y / 160.0, 1e-6);
        EXPECT_LE(glm::distance(glm::dvec3(cut.colours[v]), at), 1e-4);
    }
}

TEST(CutSite, CutsAtLeastFourByFour) {
    const SourceMesh whole = hills(40);
    EXPECT_EQ(cut_site(whole, site_frame(whole), {.max_triangles = 500'000}).value().nodes.size(), 16U);
}

TEST(CutSite, RefusesUnsuitableModelsWithAReason) {
    const auto refusal = [](const SourceMesh& mesh, const char* up, std::size_t max_triangles) {
        const auto cut =
            cut_site(mesh, make_box_frame(mesh, {up, 0.0, 0.0}).value(), {.max_triangles = max_triangles});
        EXPECT_FALSE(cut);
        return cut ? std::string() : test::told(cut.error());
    };
    EXPECT_NE(refusal(hills(20), "z", 1000).find("the model has 802 triangles; a site has at least 2000"),
              std::string::npos);
    EXPECT_NE(refusal(hills(50), "x", 1000).find("has no ground"), std::string::npos);
    EXPECT_NE(refusal(hills(120), "z", 10).find("a region holds at most 10"), std::string::npos);
}

/// Hills on a block of earth, with a floor that eyes above the ground see only where the hills are cut. `bridge`: a slab over the
/// middle, 10 m above the hills, on no pillars.
SourceMesh block_of_hills(bool bridge) {
    constexpr int n = 40;
    SourceMesh mesh = test::empty_mesh();
    mesh.default_up = 'z';
    const auto height = [](double x, double y) {
        return 30.0 + 24.0 * std::sin(0.11 * x) * std::cos(0.13 * y);
    };
    const auto quad = [&](const std::array<glm::dvec3, 4>& corners) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
        test::add_triangle(mesh, first, first + 1, first + 2);
        test::add_triangle(mesh, first, first + 2, first + 3);
    };
    const auto at = [&](int i, int j) {
        const double x = 200.0 * i / n, y = 200.0 * j / n;
        return glm::dvec3(x, y, height(x, y));
    };
    const auto foot = [&](int i, int j) { return at(i, j) * glm::dvec3(1.0, 1.0, 0.0); };
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            quad({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
            quad({foot(i, j), foot(i, j + 1), foot(i + 1, j + 1), foot(i + 1, j)});
        }
        quad({foot(j, 0), foot(j + 1, 0), at(j + 1, 0), at(j, 0)});
        quad({foot(j + 1, n), foot(j, n), at(j, n), at(j + 1, n)});
        quad({foot(0, j + 1), foot(0, j), at(0, j), at(0, j + 1)});
        quad({foot(n, j), foot(n, j + 1), at(n, j + 1), at(n, j)});
    }
    if (bridge) {
        const glm::dvec3 low(70.0, 97.0, 64.0), high(130.0, 101.0, 66.0);
        for (const double z : {low.z, high.z}) {
            quad({glm::dvec3(low.x, low.y, z), {high.x, low.y, z}, {high.x, high.y, z}, {low.x, high.y, z}});
        }
    }
    return mesh;
}

struct CountedSides {
    int down = 0, within = 0; ///< triangles that look down; on the block's floor
    int all = 0;
};
CountedSides finest_sides(const SourceMesh& mesh) {
    BakeOptions options;
    options.size = 32;
    options.unlit = true;
    options.up = "z";
    const BoxFrame frame = site_frame(mesh);
    const SourceMesh regions = cut_site(mesh, frame, {.max_triangles = 100'000}).value();
    CountedSides sides;
    for (const pack::Pack& region : bake_cells(regions, frame, options, CellSides::OfSite).geometry) {
        const TriangleMesh finest = surface_of(region.levels.back(), region.box_size);
        for (std::size_t t = 0; t < finest.triangle_count(); ++t) {
            const glm::vec3 normal = glm::normalize(finest.area_normal(t));
            ++sides.all;
            sides.down += normal.z < -0.01F ? 1 : 0;
            sides.within += std::abs(normal.z) > 0.99F && finest.corner(t, 0).z < 1e-3F ? 1 : 0;
        }
    }
    return sides;
}

TEST(SiteRegions, ShowTheFloorOfACutHillAndNoUnderside) {
    const SourceMesh mesh = block_of_hills(false);
    const CountedSides sides = finest_sides(mesh);
    // A visible side is kept with the triangles that touch it: two of the floor for each quad of the block's sides.
    constexpr int margin = 8 * 40;
    EXPECT_LE(sides.down, margin);
    constexpr int floor = 2 * 40 * 40;
    EXPECT_GE(sides.within, floor / 2) << "the earth inside a hill that the prop cuts";
    EXPECT_LE(sides.within, floor + margin);
    EXPECT_GE(sides.all, 2 * 40 * 40 + 8 * 40 + sides.within); // the hills and the block's sides
    EXPECT_LE(sides.all, 2 * 40 * 40 + 8 * 40 + sides.within + margin);
}

TEST(SiteRegions, KeepTheUndersideOfABridgeOverACut) {
    EXPECT_GT(finest_sides(block_of_hills(true)).down, 4);
}

} // namespace
} // namespace frustumscreen::bake
