// True figures are accepted, false ones are detected.

#include "app/bench/measures/figures.h"
#include "assets_baked/bake/bake.h"
#include "tests/bench/ring.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace frustumscreen::bench {
namespace {

TEST(PackFigures, MeasuringDetectsFalseOnes) {
    const auto mesh = ring();
    bake::BakeOptions options;
    options.size = 64;
    options.relief = false;
    options.unlit = true;
    const pack::Pack pack = bake::bake(*mesh, options).value();
    ASSERT_GT(pack.levels.size(), 1U);
    std::vector<LevelFigures> figures = measure_figures(pack, *mesh);
    ASSERT_EQ(figures.size(), pack.levels.size());
    constexpr double mm_per_box = 80.0;
    for (const LimitVerdict& verdict : judge(figures, mm_per_box)) {
        EXPECT_TRUE(verdict.held) << verdict.what << "; " << verdict.found;
    }
    EXPECT_TRUE(require_true(judge(figures, mm_per_box), "cat.fspack"));
    const float true_p95 = figures[0].said.p95_box;
    ASSERT_GT(true_p95, 5e-4F); // of the coarsest level, far above the slack
    for (const float lie : {0.0F, 0.3F * true_p95, 3.0F * true_p95, std::nanf("")}) {
        figures[0].said.p95_box = lie;
        const std::vector<LimitVerdict> verdicts = judge(figures, mm_per_box);
        EXPECT_FALSE(verdicts[0].held) << lie;
        EXPECT_TRUE(
            std::all_of(verdicts.begin() + 1, verdicts.end(), [](const LimitVerdict& v) { return v.held; }));
        const Result<void> required = require_true(verdicts, "cat.fspack");
        ASSERT_FALSE(required);
        EXPECT_EQ(required.error().message.find("cat.fspack: "), 0U);
        EXPECT_EQ(required.error().message.find('\n'), std::string::npos);
        EXPECT_NE(verdicts[0].what.find("the pack says"), std::string::npos);
        EXPECT_NE(verdicts[0].found.find("measured"), std::string::npos);
    }
}

} // namespace
} // namespace frustumscreen::bench
