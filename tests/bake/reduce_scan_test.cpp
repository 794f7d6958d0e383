// Reduced scans, held against shapes whose distance is known, and against the scan by ray casts.
#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/level.h"
#include "assets_baked/bake/reduce_scan.h"
#include "assets_baked/bake/source_scene.h"
#include "tests/bake/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace frustumscreen::bake {
namespace {

using namespace test;

constexpr ReduceLimits small{.most = 5'000, .wanted = 4'000, .samples = 4'000};

SourceMesh sphere(int rows) {
    SourceMesh mesh = empty_mesh();
    add_sphere(mesh, {10.0, -4.0, 2.0}, 2.0, rows);
    return mesh;
}

/// A square of `side` x `side` quads in the plane z = height(x, y), from (0, 0) to (1, 1).
template <typename Height> SourceMesh sheet(int side, const Height& height) {
    SourceMesh mesh = empty_mesh();
    for (int j = 0; j <= side; ++j) {
        for (int i = 0; i <= side; ++i) {
            const double x = static_cast<double>(i) / side;
            const double y = static_cast<double>(j) / side;
            mesh.positions.emplace_back(x, y, height(x, y));
        }
    }
    for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) {
            const auto at = [&](int dj, int di) {
                return static_cast<std::uint32_t>((j + dj) * (side + 1) + i + di);
            };
            add_triangle(mesh, at(0, 0), at(0, 1), at(1, 1));
            add_triangle(mesh, at(0, 0), at(1, 1), at(1, 0));
        }
    }
    return mesh;
}

/// Edges by their ends' positions, with the number of triangles at each.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges_of(const SourceMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& triangle : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
            ++edges[{low, high}];
        }
    }
    return edges;
}

double mean_over(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

TEST(ReduceScan, LeavesAScanWithinTheLimit) {
    SourceMesh mesh = sphere(30);
    const SourceMesh before = mesh;
    reduce_scan(mesh, small);
    EXPECT_EQ(mesh.triangles, before.triangles);
    EXPECT_EQ(mesh.positions, before.positions);
    EXPECT_FALSE(mesh.reduced_from);
    EXPECT_TRUE(mesh.notes.empty());
}

TEST(ReduceScan, LeavesAboutTheWantedNumber) {
    SourceMesh mesh = sphere(150);
    const std::size_t triangles = mesh.triangles.size();
    reduce_scan(mesh, small);
    EXPECT_GT(mesh.triangles.size(), small.wanted * 7 / 10);
    EXPECT_LT(mesh.triangles.size(), small.wanted * 13 / 10);
    ASSERT_TRUE(mesh.reduced_from);
    EXPECT_EQ(mesh.reduced_from->triangles, triangles);
    EXPECT_EQ(mesh.triangle_materials.size(), mesh.triangles.size());
    ASSERT_EQ(mesh.notes.size(), 1U);
    EXPECT_EQ(mesh.notes[0].kind, SourceNote::Kind::Guessed);
}

TEST(ReduceScan, KeepsAClosedSurfaceClosedAndOutward) {
    SourceMesh mesh = sphere(150);
    reduce_scan(mesh, small);
    std::size_t odd = 0;
    for (const auto& [edge, triangles] : edges_of(mesh)) {
        odd += triangles == 2 ? 0 : 1;
    }
    EXPECT_LE(odd, edges_of(mesh).size() / 100); // the sphere's poles have degenerate triangles
    double volume = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const glm::dvec3 centre(10.0, -4.0, 2.0);
        volume += glm::dot(mesh.positions[a] - centre,
                           glm::cross(mesh.positions[b] - centre, mesh.positions[c] - centre)) /
                  6.0;
    }
    EXPECT_NEAR(volume, 4.0 / 3.0 * std::numbers::pi * 8.0, 0.1);
}

TEST(ReduceScan, ReportsTheDistanceOfBothSurfaces) {
    SourceMesh mesh = sphere(150);
    reduce_scan(mesh, small);
    std::vector<double> from_sphere;
    for (const auto& [a, b, c] : mesh.triangles) {
        const glm::dvec3 middle = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3.0;
        from_sphere.push_back(std::abs(glm::distance(middle, glm::dvec3(10.0, -4.0, 2.0)) - 2.0));
    }
    ASSERT_TRUE(mesh.reduced_from);
    const SourceReduction& told = *mesh.reduced_from;
    EXPECT_NEAR(told.mean, mean_over(from_sphere), 0.5 * mean_over(from_sphere));
    EXPECT_GE(told.max, *std::max_element(from_sphere.begin(), from_sphere.end()) * 0.7);
    EXPECT_LE(told.mean, told.p95);
    EXPECT_LE(told.p95, told.max);
    EXPECT_LT(told.max, 0.05);
}

TEST(ReduceScan, KeepsASharpEdge) {
    SourceMesh mesh = sheet(100, [](double x, double) { return std::abs(x - 0.503); });
    reduce_scan(mesh, small);
    double lowest = 1.0;
    std::set<std::uint32_t> used;
    for (const auto& triangle : mesh.triangles) {
        used.insert(triangle.begin(), triangle.end());
    }
    double farthest = 0.0;
    for (const std::uint32_t vertex : used) {
        const glm::dvec3& p = mesh.positions[vertex];
        lowest = std::min(lowest, p.z);
        farthest = std::max(farthest, std::abs(p.z - std::abs(p.x - 0.503)));
    }
    EXPECT_LT(lowest, 0.006); // the sheet's own grid has its lowest line at 0.003
    EXPECT_LT(farthest, 0.008);
}

TEST(ReduceScan, KeepsAWireThatIsThinnerThanACell) {
    SourceMesh mesh = sphere(150);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    constexpr int rings = 400;
    for (int k = 0; k <= rings; ++k) {
        const double x = 12.0 + 2.0 * k / rings;
        for (int i = 0; i < 3; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / 3.0;
            mesh.positions.emplace_back(x, -4.0 + 1e-3 * std::cos(angle), 2.0 + 1e-3 * std::sin(angle));
        }
    }
    for (std::uint32_t k = 0; k < rings; ++k) {
        for (std::uint32_t i = 0; i < 3; ++i) {
            const std::uint32_t a = first + 3 * k + i;
            const std::uint32_t b = first + 3 * k + (i + 1) % 3;
            add_triangle(mesh, a, b, b + 3);
            add_triangle(mesh, a, b + 3, a + 3);
        }
    }
    reduce_scan(mesh, small);
    double farthest = 0.0;
    for (const auto& triangle : mesh.triangles) {
        farthest = std::max(farthest, mesh.positions[triangle[0]].x);
    }
    EXPECT_GT(farthest, 13.98);
    ASSERT_TRUE(mesh.reduced_from);
    EXPECT_LT(mesh.reduced_from->max, 0.05);
}

TEST(ReduceScan, NeverMixesChartsOfTextureCoordinates) {
    SourceMesh mesh = sheet(100, [](double, double) { return 0.0; });
    // The halves left and right of x = 0.5 lie far apart in the picture, and share no vertex.
    const std::size_t vertices = mesh.positions.size();
    for (std::size_t k = 0; k < vertices; ++k) {
        mesh.uvs.emplace_back(0.2F * static_cast<float>(mesh.positions[k].x), mesh.positions[k].y);
    }
    std::map<std::uint32_t, std::uint32_t> twins;
    for (auto& triangle : mesh.triangles) {
        const bool right = std::any_of(triangle.begin(), triangle.end(),
                                       [&](std::uint32_t v) { return mesh.positions[v].x > 0.505; });
        for (std::uint32_t& vertex : triangle) {
            if (right) {
                const auto [twin, is_new] =
                    twins.try_emplace(vertex, static_cast<std::uint32_t>(mesh.positions.size()));
                if (is_new) {
                    const glm::dvec3 position = mesh.positions[vertex];
                    mesh.positions.push_back(position);
                    mesh.uvs.emplace_back(0.7F + 0.2F * static_cast<float>(position.x), position.y);
                }
                vertex = twin->second;
            }
        }
    }
    reduce_scan(mesh, small);
    ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle) {
            const float u = mesh.uvs[vertex].x;
            const auto x = static_cast<float>(mesh.positions[vertex].x);
            const float expected = u > 0.5F ? 0.7F + 0.2F * x : 0.2F * x;
            EXPECT_NEAR(u, expected, 0.006F);
            EXPECT_NEAR(mesh.uvs[vertex].y, static_cast<float>(mesh.positions[vertex].y), 0.03F);
        }
    }
}

TEST(ReduceScan, AveragesColoursAndNormalsOfACell) {
    SourceMesh mesh = sheet(100, [](double, double) { return 0.0; });
    for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
        const float shade = k % 2 == 0 ? 0.2F : 0.6F;
        mesh.colours.emplace_back(shade, shade, shade, 1.0F);
        mesh.normals.emplace_back(0.0F, 0.0F, 1.0F);
    }
    reduce_scan(mesh, small);
    ASSERT_EQ(mesh.colours.size(), mesh.positions.size());
    double sum = 0.0;
    for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
        sum += static_cast<double>(mesh.colours[k].x);
        EXPECT_FLOAT_EQ(mesh.colours[k].w, 1.0F);
        EXPECT_FLOAT_EQ(mesh.normals[k].z, 1.0F);
    }
    EXPECT_NEAR(sum / static_cast<double>(mesh.positions.size()), 0.4, 0.02);
}

TEST(ReduceScan, TrianglesThatShareNoVertexAreReducedToo) {
    const SourceMesh joined = sphere(150);
    SourceMesh mesh = empty_mesh();
    for (const auto& triangle : joined.triangles) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const std::uint32_t vertex : triangle) {
            mesh.positions.push_back(joined.positions[vertex]);
        }
        add_triangle(mesh, first, first + 1, first + 2);
    }
    reduce_scan(mesh, small);
    EXPECT_LT(mesh.triangles.size(), small.wanted * 13 / 10);
    ASSERT_TRUE(mesh.reduced_from);
    EXPECT_NEAR(static_cast<double>(mesh.reduced_from->points), 149.0 * 300.0 + 2.0, 2.0);
}

TEST(ReduceScan, LeavesAScanWithoutArea) {
    SourceMesh mesh = empty_mesh();
    mesh.positions = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
    for (int k = 0; k < 6'000; ++k) {
        add_triangle(mesh, 0, 1, 2);
    }
    reduce_scan(mesh, small);
    EXPECT_EQ(mesh.triangles.size(), 6'000U);
}

/// Points spread evenly over a triangle.
std::vector<glm::vec3> points_of(const TriangleMesh& surface, std::size_t triangle) {
    constexpr int steps = 6;
    std::vector<glm::vec3> points;
    for (int i = 0; i < steps; ++i) {
        for (int j = 0; i + j < steps; ++j) {
            const float u = (static_cast<float>(i) + 1.0F / 3.0F) / steps;
            const float v = (static_cast<float>(j) + 1.0F / 3.0F) / steps;
            points.push_back(surface.corner(triangle, 0) * (1.0F - u - v) + surface.corner(triangle, 1) * u +
                             surface.corner(triangle, 2) * v);
        }
    }
    return points;
}

TEST(ReduceScan, ABakesErrorsHoldAgainstTheScanItself) {
    const SourceMesh scan = sheet(120, [](double x, double y) {
        return 0.3 * x * (1.0 - x) + 0.004 * std::sin(90.0 * x) * std::sin(70.0 * y);
    });
    SourceMesh reduced = scan;
    reduce_scan(reduced, small);
    BakeOptions options;
    options.size = 128;
    options.measuring = 0.2;
    options.relief = false;
    const Result<pack::Pack> pack = bake(reduced, options);
    ASSERT_TRUE(pack) << pack.error().message;
    EXPECT_EQ(pack->provenance.source_triangles, scan.triangles.size());
    const std::vector<glm::dvec3> points = in_box(scan, pack->box_from_file);
    const SourceScene truth(scan, points);
    for (const pack::PackLevel& level : pack->levels) {
        const TriangleMesh surface = surface_of(level, pack->box_size);
        double sum = 0.0;
        double area = 0.0;
        for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
            const std::vector<glm::vec3> spread = points_of(surface, t);
            const double weight =
                static_cast<double>(glm::length(surface.area_normal(t))) / static_cast<double>(spread.size());
            for (const glm::vec3& point : spread) {
                const SurfaceHit hit = truth.nearest(point, 0.2F);
                ASSERT_TRUE(hit.hit);
                EXPECT_LE(hit.distance, 1.1F * level.error.max_box);
                sum += weight * static_cast<double>(hit.distance);
                area += weight;
            }
        }
        EXPECT_LE(sum / area, 1.1 * static_cast<double>(level.error.mean_box));
        EXPECT_GE(sum / area, 0.2 * static_cast<double>(level.error.mean_box));
    }
}

} // namespace
} // namespace frustumscreen::bake
