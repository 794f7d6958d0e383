// The paper's choice by hand-made cells.

#include "app/bench/mixed/paper_choice.h"

#include <gtest/gtest.h>

#include <vector>

namespace frustumscreen::bench {
namespace {

PaperCell cell(double texel_px, double away_m, double cosine, double area_share, std::size_t polygons) {
    return {.texel_px = texel_px,
            .away_m = away_m,
            .cosine = cosine,
            .area_share = area_share,
            .polygons = polygons,
            .relief_error_mm = 1.0,
            .polygon_error_mm = 0.0};
}

std::vector<int> chosen(PaperChoice choice, const std::vector<PaperCell>& cells) {
    const std::span<const std::uint8_t> polygons = choice.choose(cells);
    return {polygons.begin(), polygons.end()};
}

constexpr PaperWeights distance_alone{.u = 0.0, .v = 1.0, .w = 0.0, .x = 0.0};

TEST(PaperChoice, ImportanceIsTheSumOfFourWeightedTerms) {
    const PaperCell one = cell(2.0, 0.5, 0.75, 0.125, 10);
    EXPECT_DOUBLE_EQ(importance(one, {.u = 1.0, .v = 0.0, .w = 0.0, .x = 0.0}), 2.0);
    EXPECT_DOUBLE_EQ(importance(one, distance_alone), 2.0); // 1 / 0.5
    EXPECT_DOUBLE_EQ(importance(one, {.u = 0.0, .v = 0.0, .w = 1.0, .x = 0.0}), 0.75);
    EXPECT_DOUBLE_EQ(importance(one, {.u = 0.0, .v = 0.0, .w = 0.0, .x = 1.0}), 0.125);
    EXPECT_DOUBLE_EQ(importance(one, {.u = 0.5, .v = 0.25, .w = 1.0, .x = 0.5}), 1.0 + 0.5 + 0.75 + 0.0625);
}

TEST(PaperChoice, TheMostImportantCellsArePolygonsWithinTheBudget) {
    const std::vector<PaperCell> cells{cell(2, 3.0, 1, 0, 100), cell(2, 1.0, 1, 0, 300),
                                       cell(2, 2.0, 1, 0, 200)};
    EXPECT_EQ(chosen({distance_alone, 0.0}, cells), (std::vector{0, 0, 0}));
    EXPECT_EQ(chosen({distance_alone, 300.0}, cells), (std::vector{0, 1, 0}));
    EXPECT_EQ(chosen({distance_alone, 500.0}, cells), (std::vector{0, 1, 1}));
    EXPECT_EQ(chosen({distance_alone, 600.0}, cells), (std::vector{1, 1, 1}));
    // An object that does not fit is skipped; a less important one may fit.
    EXPECT_EQ(chosen({distance_alone, 299.0}, cells), (std::vector{0, 0, 1}));
    EXPECT_EQ(chosen({distance_alone, 150.0}, cells), (std::vector{1, 0, 0}));
}

TEST(PaperChoice, KeepsReliefForTexelsNoLargerThanAPixel) {
    const std::vector<PaperCell> cells{cell(1.0, 0.1, 1, 0, 10), cell(1.01, 5.0, 1, 0, 10)};
    EXPECT_EQ(chosen({distance_alone, 1e9}, cells), (std::vector{0, 1}));
}

TEST(PaperChoice, CountsTheCellsThatChange) {
    PaperChoice choice(distance_alone, 100.0);
    std::vector<PaperCell> cells{cell(2, 1.0, 1, 0, 100), cell(2, 2.0, 1, 0, 100)};
    (void)choice.choose(cells);
    EXPECT_EQ(choice.switches(), 0U);
    (void)choice.choose(cells);
    EXPECT_EQ(choice.switches(), 0U);
    cells[0].away_m = 3.0; // the other one is nearer now
    (void)choice.choose(cells);
    EXPECT_EQ(choice.switches(), 2U);
}

TEST(PaperChoice, SearchFindsWeightsThatPredictErrors) {
    // The cell of more relief error is the nearer one, and every other term says the opposite.
    std::vector<std::vector<PaperCell>> frames;
    for (int frame = 0; frame < 4; ++frame) {
        PaperCell near = cell(1.5, 0.5 + 0.1 * frame, 0.2, 0.1, 100);
        near.relief_error_mm = 5.0;
        PaperCell far = cell(3.0, 2.0, 0.9, 0.4, 100);
        far.relief_error_mm = 0.5;
        frames.push_back({far, near});
    }
    const std::vector<double> budgets{100.0};
    const PaperWeights found = find_weights(frames, budgets);
    for (const std::vector<PaperCell>& cells : frames) {
        EXPECT_EQ(chosen({found, 100.0}, cells), (std::vector{0, 1}));
    }
}

} // namespace
} // namespace frustumscreen::bench
