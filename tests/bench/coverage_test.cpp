// The estimate of a frame's error against the ray cast, on shapes that were not used to derive it; and the
// rule for covered poses.

#include "app/bench/measures/coverage.h"
#include "app/pack/pack_relief.h"
#include "assets_baked/bake/bake.h"
#include "tests/bake/shapes.h"
#include "tests/bench/near_settings.h"
#include "tests/bench/ring.h"

#include <gtest/gtest.h>

namespace frustumscreen::bench {
namespace {

TechniqueResult technique_of(std::vector<double> true_mm,
                             std::vector<std::optional<scene::ErrorEstimate>> estimates) {
    TechniqueResult technique;
    technique.name = "mesh 0";
    for (const double mm : true_mm) {
        PictureError error;
        error.truth_pixels = 100;
        error.geometric_mean_mm = mm;
        technique.errors.push_back(error);
    }
    technique.estimates = std::move(estimates);
    return technique;
}

TEST(Coverage, CountsPosesNearTheEstimateAndBelowItsP95) {
    const scene::ErrorEstimate one{1.0, 3.0};
    const Coverage coverage =
        coverage_of(technique_of({0.69, 0.71, 1.0, 1.39, 1.41, 1.2, 5.0},
                                 {one, one, one, one, one, scene::ErrorEstimate{1.0, 1.1}, std::nullopt}));
    EXPECT_EQ(coverage.poses, 6U);
    EXPECT_EQ(coverage.covered, 3U);
    EXPECT_EQ(coverage.below_p95, 5U);
    EXPECT_NEAR(coverage.ratio.median, 1.0, 0.2);
    EXPECT_EQ(coverage_of(technique_of({1.0}, {})).poses, 0U); // a peer has no estimates
}

TEST(Coverage, RequiresNineTenthsOfAllPoses) {
    const auto with = [](std::size_t covered) {
        return std::vector<NamedCoverage>{{"a", "near", "mesh 0", {10, 10, 10, {}}},
                                          {"b, c", "kiosk", "mesh 1", {10, covered, 10, {}}}};
    };
    EXPECT_TRUE(judge(with(8)).held);
    EXPECT_FALSE(judge(with(7)).held);
    EXPECT_FALSE(judge(std::vector<NamedCoverage>{}).held); // nothing was measured
    EXPECT_NE(coverage_csv(with(8)).find("\"b, c\",\"kiosk\",\"mesh 1\",10,8,10,"), std::string::npos);
}

/// Separate convex bodies, a ball, a box and a thin plate, with edges that hide each other.
std::shared_ptr<bake::SourceMesh> things() {
    auto mesh = std::make_shared<bake::SourceMesh>(test::empty_mesh());
    test::add_sphere(*mesh, {-0.2, 0.0, 0.3}, 0.25, 40);
    test::add_box(*mesh, {0.15, -0.1, 0.05}, {0.4, 0.3, 0.6});
    test::add_box(*mesh, {-0.3, -0.35, 0.05}, {0.3, -0.34, 0.4});
    return mesh;
}

void expect_covered(const std::shared_ptr<const bake::SourceMesh>& mesh, double max_median) {
    bake::BakeOptions options;
    options.size = 64;
    options.unlit = true;
    const pack::Pack pack = bake::bake(*mesh, options).value();
    SetUp set_up{"near", near_settings()};
    set_up.settings.projector.pinhole = set_up.settings.projector.pinhole.scaled_to(1280, 800);
    const SetUpResult result = measure_estimates(set_up, pack, mesh, {.poses = 4, .seed = 7, .rays = 4},
                                                 [](const std::string&, double) {})
                                   .value();
    const std::vector<NamedCoverage> rows = coverages_of("shape", result);
    EXPECT_EQ(rows.size(),
              pack.levels.size() + pack::reliefs_of(pack).value().size() + 1); // plus the choice of
                                                                               // `auto`
    double poses = 0.0;
    double covered = 0.0;
    for (const NamedCoverage& row : rows) {
        EXPECT_EQ(row.coverage.poses, 4U) << row.level;
        EXPECT_GT(row.coverage.ratio.median, min_of_estimate) << row.level;
        EXPECT_LT(row.coverage.ratio.median, max_median) << row.level;
        poses += static_cast<double>(row.coverage.poses);
        covered += static_cast<double>(row.coverage.covered);
    }
    // A small shape has few pixels on occluding edges, and each is a large share of the mean.
    // `frustumscreen-bench estimate` checks the limit for scans.
    EXPECT_GT(covered, 0.6 * poses) << coverage_table(rows);
}

TEST(Coverage, HoldsForARing) {
    expect_covered(ring(), max_of_estimate);
}

/// Boxes have errors only at their edges: for the two finest levels the estimate is 1.6 and 1.7 times too
/// small.
TEST(Coverage, HoldsForObjectsThatOccludeEachOther) {
    expect_covered(things(), 1.8);
}

} // namespace
} // namespace frustumscreen::bench
