// The paper's splitting of lit triangles and ours by the bound: against dense sampling, and edge by edge.

#include "app/bench/truth/seeded_draw.h"
#include "app/torch/splitting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <vector>

namespace frustumscreen::torch {
namespace {

using bench::SeededDraw;

constexpr std::array all_attenuations{Attenuation::InverseSquare, Attenuation::Linear,
                                      Attenuation::SmoothStep, Attenuation::None};

Beam beam_of(Attenuation attenuation) {
    return {.opening_rad = 1.2,
            .height_per_width = 0.8,
            .shape = Shape::Rectangle,
            .attenuation = attenuation,
            .full_m = 0.1,
            .dark_m = 0.6};
}

glm::dvec3 point_in(SeededDraw& draw, double size_m) {
    return {draw.between(-size_m, size_m), draw.between(-size_m, size_m), draw.between(-size_m, size_m)};
}

/// Around a middle before the torch; `place` is the point itself.
MeshTriangle triangle_at(const TriangleSplitter& splitter, const std::array<glm::dvec3, 3>& points) {
    return {splitter.corner(points[0], points[0]), splitter.corner(points[1], points[1]),
            splitter.corner(points[2], points[2])};
}
std::array<glm::dvec3, 3> points_around(SeededDraw& draw, const glm::dvec3& middle, double size_m) {
    return {middle + point_in(draw, size_m), middle + point_in(draw, size_m),
            middle + point_in(draw, size_m)};
}

double area_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return 0.5 * glm::length(glm::cross(b - a, c - a));
}
double area_of(const std::vector<LitCorner>& lit) {
    double sum = 0.0;
    for (std::size_t k = 0; k < lit.size(); k += 3) {
        sum += area_of(lit[k].place, lit[k + 1].place, lit[k + 2].place);
    }
    return sum;
}

/// Calls `at(weights)` for a grid over the triangle, its corners and edges too.
template <typename At> void sample(int steps, const At& at) {
    for (int i = 0; i <= steps; ++i) {
        for (int j = 0; i + j <= steps; ++j) {
            at(glm::dvec3(i, j, steps - i - j) / static_cast<double>(steps));
        }
    }
}

double sampled_error(const Beam& beam, const MeshTriangle& triangle) {
    double largest = 0.0;
    sample(40, [&](const glm::dvec3& w) {
        const glm::dvec3 point =
            w.x * triangle[0].point_torch + w.y * triangle[1].point_torch + w.z * triangle[2].point_torch;
        const double linear =
            w.x * triangle[0].intensity + w.y * triangle[1].intensity + w.z * triangle[2].intensity;
        largest = std::max(largest, std::abs(linear - attenuation_at(beam, glm::length(point))));
    });
    return largest;
}

bool holds(const std::vector<LitCorner>& lit, const glm::dvec3& point) {
    for (std::size_t k = 0; k < lit.size(); k += 3) {
        const glm::dvec3 a(lit[k].place);
        const glm::dvec3 b(lit[k + 1].place);
        const glm::dvec3 c(lit[k + 2].place);
        const double whole = area_of(a, b, c);
        if (area_of(point, b, c) + area_of(a, point, c) + area_of(a, b, point) <= whole + 1e-6) {
            return true;
        }
    }
    return false;
}

TEST(TriangleSplitter, PartsKeepTheTrianglesAreaAndWinding) {
    SeededDraw draw(1);
    const TriangleSplitter splitter(beam_of(Attenuation::SmoothStep));
    for (int k = 0; k < 100; ++k) {
        const std::array<glm::dvec3, 3> points = points_around(draw, {0.0, 0.0, 0.35}, 0.07);
        const glm::dvec3 normal = glm::cross(points[1] - points[0], points[2] - points[0]);
        for (const Splitting& splitting :
             {Splitting{Splitting::By::Length, 0.012}, Splitting{Splitting::By::Bound, 0.003}}) {
            std::vector<LitCorner> lit;
            splitter.split(triangle_at(splitter, points), splitting, lit);
            ASSERT_GE(lit.size(), 3U);
            EXPECT_NEAR(area_of(lit), area_of(points[0], points[1], points[2]), 1e-8);
            for (std::size_t corner = 0; corner < lit.size(); corner += 3) {
                const glm::dvec3 a(lit[corner].place);
                const glm::dvec3 part =
                    glm::cross(glm::dvec3(lit[corner + 1].place) - a, glm::dvec3(lit[corner + 2].place) - a);
                EXPECT_GE(glm::dot(part, normal), -1e-12);
            }
        }
    }
}

TEST(TriangleSplitter, NoEdgeIsLongerThanTheTolerance) {
    SeededDraw draw(2);
    const TriangleSplitter splitter(beam_of(Attenuation::Linear));
    constexpr double tolerance_m = 0.01;
    std::vector<LitCorner> lit;
    for (int k = 0; k < 50; ++k) {
        splitter.split(triangle_at(splitter, points_around(draw, {0.0, 0.0, 0.4}, 0.3)),
                       {Splitting::By::Length, tolerance_m}, lit);
    }
    ASSERT_GT(lit.size(), 1000U);
    for (std::size_t k = 0; k < lit.size(); k += 3) {
        for (std::size_t edge = 0; edge < 3; ++edge) {
            EXPECT_LE(glm::distance(lit[k + edge].place, lit[k + (edge + 1) % 3].place), tolerance_m + 1e-6);
        }
    }
}

TEST(TriangleSplitter, CullsNothingThatIsLit) {
    SeededDraw draw(3);
    int lit_points = 0;
    int culled = 0;
    for (int k = 0; k < 2000; ++k) {
        const Beam beam = beam_of(all_attenuations.at(static_cast<std::size_t>(k) % 4));
        const TriangleSplitter splitter(beam);
        const std::array<glm::dvec3, 3> points = points_around(draw, point_in(draw, 0.6), 0.7);
        std::vector<LitCorner> lit;
        splitter.split(triangle_at(splitter, points), {Splitting::By::Length, 0.4}, lit);
        culled += lit.empty() ? 1 : 0;
        sample(6, [&](const glm::dvec3& w) {
            const glm::dvec3 point = w.x * points[0] + w.y * points[1] + w.z * points[2];
            if (intensity_at(beam, point) > 0.0) {
                ++lit_points;
                EXPECT_TRUE(holds(lit, point));
            }
        });
    }
    EXPECT_GT(lit_points, 1000);
    EXPECT_GT(culled, 200);
}

/// A fan around the middle, so that each of its inner edges has two triangles.
TEST(TriangleSplitter, SplittingByLengthLeavesNoTJunctions) {
    const TriangleSplitter splitter(beam_of(Attenuation::InverseSquare));
    SeededDraw draw(4);
    constexpr std::size_t rim = 9;
    const glm::dvec3 hub(0.01, 0.0, 0.4);
    std::vector<glm::dvec3> around;
    for (std::size_t k = 0; k < rim; ++k) {
        const double angle = 0.698131700797732 * static_cast<double>(k);
        const double away_m = draw.between(0.03, 0.12);
        around.emplace_back(away_m * std::cos(angle), away_m * std::sin(angle), draw.between(0.38, 0.45));
    }
    std::vector<LitCorner> lit;
    for (std::size_t k = 0; k < rim; ++k) {
        // The shared edge runs the other way in every second triangle.
        std::array<glm::dvec3, 3> points{hub, around[k], around[(k + 1) % rim]};
        std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(k % 3), points.end());
        splitter.split(triangle_at(splitter, points), {Splitting::By::Length, 0.009}, lit);
    }
    using Corner = std::tuple<float, float, float>;
    std::map<std::pair<Corner, Corner>, int> edges; // directed
    for (std::size_t k = 0; k < lit.size(); k += 3) {
        for (std::size_t edge = 0; edge < 3; ++edge) {
            const auto corner = [&](std::size_t at) {
                const glm::vec3& place = lit[k + at % 3].place;
                return Corner(place.x, place.y, place.z);
            };
            ++edges[{corner(edge), corner(edge + 1)}];
        }
    }
    std::size_t alone = 0;
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        alone += edges.count({edge.second, edge.first}) == 0 ? 1 : 0;
    }
    std::size_t on_rim = 0; // pieces of the outer edges alone have one triangle
    for (std::size_t k = 0; k < rim; ++k) {
        double length = glm::distance(around[k], around[(k + 1) % rim]);
        std::size_t pieces = 1;
        for (; length > 0.009; length /= 2.0) {
            pieces *= 2;
        }
        on_rim += pieces;
    }
    EXPECT_EQ(alone, on_rim);
    EXPECT_GT(edges.size(), 1000U);
}

TEST(TriangleSplitter, TheBoundHoldsAgainstDenseSampling) {
    SeededDraw draw(5);
    for (const Attenuation attenuation : all_attenuations) {
        const Beam beam = beam_of(attenuation);
        const TriangleSplitter splitter(beam);
        std::vector<double> slack;
        for (int k = 0; k < 1500; ++k) {
            // From a millimetre to larger than the beam, through the source, its full and its dark way.
            const double size_m = 0.001 * std::pow(1000.0, draw.between(0.0, 1.0));
            const glm::dvec3 middle = (0.02 + draw.between(0.0, 0.9)) * glm::normalize(point_in(draw, 1.0));
            const MeshTriangle triangle = triangle_at(splitter, points_around(draw, middle, size_m));
            const double sampled = sampled_error(beam, triangle);
            const double bound = splitter.max_error(triangle);
            EXPECT_LE(sampled, bound * (1.0 + 1e-9) + 1e-15)
                << attenuation_names.at(static_cast<std::size_t>(attenuation)) << ", triangle " << k;
            if (sampled > 1e-7 && size_m < 0.03) {
                slack.push_back(bound / sampled);
            }
        }
        if (attenuation == Attenuation::None) {
            EXPECT_TRUE(slack.empty());
            continue;
        }
        ASSERT_GT(slack.size(), 200U);
        std::nth_element(slack.begin(), slack.begin() + static_cast<std::ptrdiff_t>(slack.size() / 2),
                         slack.end());
        EXPECT_LT(slack[slack.size() / 2], 4.0); // a bound that says nothing would hold too
    }
}

/// The largest error of a split wall, and its triangles.
struct Split {
    double error = 0.0;
    std::size_t triangles = 0;
};
Split split_wall(const Beam& beam, const Splitting& splitting) {
    const TriangleSplitter splitter(beam);
    const std::array<glm::dvec3, 4> wall{glm::dvec3(-0.5, -0.4, 0.15), glm::dvec3(0.5, -0.4, 0.25),
                                         glm::dvec3(0.5, 0.4, 0.25), glm::dvec3(-0.5, 0.4, 0.15)};
    std::vector<LitCorner> lit;
    splitter.split(triangle_at(splitter, {wall[0], wall[1], wall[2]}), splitting, lit);
    splitter.split(triangle_at(splitter, {wall[0], wall[2], wall[3]}), splitting, lit);
    Split split{.triangles = lit.size() / 3};
    for (std::size_t k = 0; k < lit.size(); k += 3) {
        split.error = std::max(
            split.error,
            sampled_error(beam, triangle_at(splitter, {lit[k].place, lit[k + 1].place, lit[k + 2].place})));
    }
    return split;
}

TEST(TriangleSplitter, BoundMeetsItsToleranceWithFewerTrianglesThanLength) {
    int fewer = 0;
    for (const Attenuation attenuation :
         {Attenuation::InverseSquare, Attenuation::Linear, Attenuation::SmoothStep}) {
        const Beam beam = beam_of(attenuation);
        const Split ours = split_wall(beam, {Splitting::By::Bound, 0.004});
        EXPECT_LE(ours.error, 0.004 + 1e-6);
        double length_m = 0.2; // the longest that errs as little
        Split paper = split_wall(beam, {Splitting::By::Length, length_m});
        while (paper.error > ours.error) {
            length_m *= 0.9;
            paper = split_wall(beam, {Splitting::By::Length, length_m});
        }
        EXPECT_LE(ours.triangles, paper.triangles)
            << attenuation_names.at(static_cast<std::size_t>(attenuation));
        fewer += ours.triangles < paper.triangles ? 1 : 0;
    }
    EXPECT_GE(fewer, 2);
}

TEST(TriangleSplitter, FullListTakesTrianglesUnsplitAndSplittingTerminates) {
    const TriangleSplitter splitter(beam_of(Attenuation::InverseSquare));
    std::vector<LitCorner> lit;
    for (int k = 0; k < 20; ++k) {
        const double z = 0.3 + 0.001 * k;
        splitter.split(triangle_at(splitter, {glm::dvec3(0.0, 0.0, z), {0.1, 0.0, z}, {0.0, 0.1, z}}),
                       {Splitting::By::Length, 1e-12, 100}, lit);
    }
    EXPECT_GE(lit.size() / 3, 100U);
    EXPECT_LE(lit.size() / 3, 100U + 20U * 52U);
    lit.clear();
    const glm::dvec3 point(0.0, 0.0, 0.3);
    splitter.split(triangle_at(splitter, {point, point, point}), {Splitting::By::Length, 0.0}, lit);
    splitter.split(triangle_at(splitter, {point, point, point}), {Splitting::By::Bound, 0.0}, lit);
    EXPECT_EQ(lit.size(), 6U);
}

TEST(ToleranceControl, HoldsTheFrameTimeAndStaysInItsRange) {
    const auto ms_at = [](double tolerance, double scene) { return 4.0 + scene / (tolerance * tolerance); };
    ToleranceControl control(10.0, 0.02, {0.001, 0.05});
    for (const double scene : {6e-4, 2.4e-3, 6e-5}) { // ten times the triangles, then a fortieth
        double ms = 0.0;
        for (int frame = 0; frame < 30; ++frame) {
            ms = ms_at(control.tolerance(), scene);
            (void)control.next(ms);
        }
        EXPECT_NEAR(ms, 10.0, 0.1) << scene;
    }
    const double before = control.tolerance();
    EXPECT_EQ(control.next(std::numeric_limits<double>::quiet_NaN()), before);
    EXPECT_EQ(control.next(-1.0), before);
    for (int frame = 0; frame < 30; ++frame) {
        (void)control.next(1e9);
    }
    EXPECT_EQ(control.tolerance(), 0.05);
    for (int frame = 0; frame < 30; ++frame) {
        (void)control.next(1e-3);
    }
    EXPECT_EQ(control.tolerance(), 0.001);
}

} // namespace
} // namespace frustumscreen::torch
