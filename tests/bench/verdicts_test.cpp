#include "app/bench/measures/report.h"
#include "app/bench/measures/verdicts.h"
#include "firmware_host/base/json.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace frustumscreen::bench {
namespace {

PictureError picture_error(double silhouette_percent, double outline_px, double mm, double rmse) {
    PictureError error;
    error.silhouette_percent = silhouette_percent;
    error.outline_shift_px = outline_px;
    error.geometric_mean_mm = mm;
    error.sixteen_rays.rmse = rmse;
    return error;
}

TechniqueResult technique(const std::string& name, TechniqueKind kind, int level, double times_floor,
                          std::vector<PictureError> errors) {
    TechniqueResult result;
    result.name = name;
    result.kind = kind;
    result.level = level;
    result.drawn_as = kind == TechniqueKind::PackLevel ? name : std::string();
    result.errors = std::move(errors);
    result.error = summarise(result.errors);
    result.time_ms = {times_floor, times_floor, times_floor};
    result.times_floor = times_floor;
    return result;
}

SetUpResult example() {
    SetUpResult result;
    result.name = "near";
    result.default_level = 0;
    result.finest_level = 1;
    result.techniques = {
        technique("floor", TechniqueKind::Floor, -1, 1.0, {}),
        technique("mesh 0", TechniqueKind::PackLevel, 0, 3.0, {picture_error(0.34, 0.4, 0.1, 10.0)}),
        technique("mesh 1", TechniqueKind::PackLevel, 1, 5.0, {picture_error(0.1, 0.05, 0.03, 7.0)}),
        technique("two-pass 640", TechniqueKind::TwoPass, -1, 40.0, {picture_error(0.4, 0.3, 0.12, 9.0)})};
    result.techniques[3].triangles = 1'000'000;
    return result;
}

std::size_t missed(const std::vector<LimitVerdict>& verdicts) {
    return static_cast<std::size_t>(
        std::count_if(verdicts.begin(), verdicts.end(),
                      [](const LimitVerdict& verdict) { return !verdict.held && !verdict.wished; }));
}

TEST(Verdicts, AcceptsASilhouetteByItsShareOrItsShift) {
    const auto verdict = [](std::vector<PictureError> errors) {
        return judge(technique("t", TechniqueKind::PackLevel, 0, 1.0, std::move(errors)),
                     default_level_limits)
            .front()
            .held;
    };
    EXPECT_TRUE(verdict({picture_error(0.6, 9.0, 0, 0), picture_error(9.0, 0.3, 0, 0)}));
    EXPECT_FALSE(verdict({picture_error(0.1, 0.1, 0, 0), picture_error(0.61, 0.31, 0, 0)}));
}

TEST(Verdicts, AppliesTheDefaultLevelsLimitsToAuto) {
    SetUpResult result = example();
    result.techniques.push_back(
        technique("auto (mesh 0)", TechniqueKind::Auto, 0, 3.0, {picture_error(1.79, 0.9, 0.229, 10.0)}));
    std::vector<LimitVerdict> verdicts = judge(result);
    std::erase_if(verdicts,
                  [](const LimitVerdict& verdict) { return verdict.what.find("auto (mesh 0): ") != 0; });
    // Without the drawn shift there is no verdict on it.
    EXPECT_EQ(verdicts.size() + 1, judge(result.techniques[1], default_level_limits).size());
    EXPECT_EQ(missed(verdicts), 2U); // silhouette and geometry
    EXPECT_EQ(missed(judge(result)), 2U);
}

TEST(Verdicts, JudgesTheFasterOneOfAutosChoices) {
    for (const double mesh_cost : {3.0, 2.0}) {
        SetUpResult result = example();
        result.techniques.push_back(technique("auto (mesh 0)", TechniqueKind::Auto, 0, mesh_cost,
                                              {picture_error(0.1, 0.1, 0.1, 1.0)}));
        result.techniques.push_back(
            technique("auto (relief96)", TechniqueKind::Auto, -1, 2.5, {picture_error(0.1, 0.1, 0.1, 1.0)}));
        std::size_t of_mesh = 0;
        std::size_t of_relief = 0;
        for (const LimitVerdict& verdict : judge(result)) {
            of_mesh += verdict.what.starts_with("auto (mesh 0): ") ? 1 : 0;
            of_relief += verdict.what.starts_with("auto (relief96): ") ? 1 : 0;
        }
        EXPECT_EQ(of_mesh > 0, mesh_cost < 2.5);
        EXPECT_EQ(of_relief > 0, mesh_cost > 2.5);
    }
}

TEST(Verdicts, OneBadPoseMissesALimit) {
    TechniqueResult level = technique("t", TechniqueKind::PackLevel, 0, 1.0,
                                      {picture_error(0, 0, 0.01, 1.0), picture_error(0, 0, 0.21, 1.0)});
    EXPECT_EQ(missed(judge(level, default_level_limits)), 1U);
}

TEST(Verdicts, LimitsTheShiftFromTheMeshAndFromTheScan) {
    const auto missed_at = [](double drawn_px, double shown_px) {
        PictureError error = picture_error(0, 0, 0.01, 1.0);
        error.drawn_shift_px = drawn_px;
        error.picture_shift_px = shown_px;
        return missed(judge(technique("t", TechniqueKind::PackLevel, 0, 1.0, {error}), default_level_limits));
    };
    EXPECT_EQ(missed_at(0.049, 0.29), 0U);
    EXPECT_EQ(missed_at(0.051, 0.29), 1U);
    EXPECT_EQ(missed_at(0.0, 0.31), 1U);
    EXPECT_EQ(missed_at(0.5, 0.5), 2U); // half a pixel displaced
}

TEST(Verdicts, AppliesLimitsToTheShownPicture) {
    PictureError error = picture_error(0, 0, 0.01, 1.0);
    error.shown = ShownError{};
    error.shown->cover_px = 0.42;
    error.shown->cover_of_samples_px = 0.125; // with two samples: the error of sampling is not an error of
                                              // the outlines
    const auto missed_by = [&](double ShownError::*figure, double value) {
        PictureError one = error;
        *one.shown.*figure = value;
        return missed(judge(technique("t", TechniqueKind::PackLevel, 0, 1.0, {one}), default_level_limits));
    };
    EXPECT_EQ(missed_by(&ShownError::shift_px, 0.29), 0U);
    EXPECT_EQ(missed_by(&ShownError::shift_px, 0.31), 1U);
    EXPECT_EQ(missed_by(&ShownError::cover_bias_px, 0.31), 1U);
    EXPECT_EQ(missed_by(&ShownError::cover_px, 0.43), 1U);
    error.shown->colour.rmse = 14.1;
    EXPECT_EQ(missed_by(&ShownError::shift_px, 0.0), 1U);
    // Each pose is judged by its own samples: another pose with a larger sampling error does not excuse this
    // one.
    PictureError other = error;
    error.shown->colour.rmse = other.shown->colour.rmse = 1.0;
    other.shown->cover_px = 0.5;
    other.shown->cover_of_samples_px = 0.45;
    error.shown->cover_px = 0.43;
    EXPECT_EQ(
        missed(judge(technique("t", TechniqueKind::PackLevel, 0, 1.0, {error, other}), default_level_limits)),
        1U);
}

TEST(Verdicts, ComparesTwoPassWithTheCheapestLevelThatIsAsGood) {
    const SetUpResult result = example();
    const TechniqueResult* level = cheapest_as_good(result, result.techniques[3]);
    ASSERT_NE(level, nullptr);
    EXPECT_EQ(level->name, "mesh 1"); // mesh 0 is cheaper, but its colours are worse
    SetUpResult none = result;
    none.techniques[3].error.mean.geometric_mean_mm = 0.01;
    EXPECT_EQ(cheapest_as_good(none, none.techniques[3]), nullptr);
    EXPECT_EQ(missed(judge(result)), 0U); // 40 / 5 = 8 times
    none.techniques[3] = result.techniques[3];
    none.techniques[3].times_floor = 39.0;
    EXPECT_EQ(missed(judge(none)), 1U);
    none.techniques[3].times_floor = 100.0;
    none.techniques[3].triangles = 4'000'000; // 25 times are required here
    EXPECT_EQ(missed(judge(none)), 1U);
    none.techniques[3].triangles = 100'000; // no limit for so small a source
    EXPECT_EQ(missed(judge(none)), 0U);
}

TEST(Verdicts, ReportsMissedLimitsInOneLine) {
    std::vector<SetUpResult> results = {example(), example()};
    EXPECT_TRUE(require_limits(results));
    results[1].name = "kiosk";
    results[1].techniques[1].times_floor = 4.5;
    const Result<void> held = require_limits(results);
    ASSERT_FALSE(held);
    EXPECT_EQ(held.error().message.find("1 of the limits above are missed, the first: kiosk, default level: "
                                        "median cost <= 4 x floor (4.50 x)"),
              0U)
        << held.error().message;
    EXPECT_EQ(held.error().message.find('\n'), std::string::npos);
}

TEST(Verdicts, TheFasterFloorIsTheUnit) {
    std::vector<TechniqueResult> results = {
        technique("floor (trilinear)", TechniqueKind::Floor, -1, 5.0, {}),
        technique("floor (one mip level)", TechniqueKind::Floor, -1, 4.0, {}),
        technique("faster than any floor", TechniqueKind::PackLevel, 0, 2.0, {})};
    for (std::size_t k = 0; k < results.size(); ++k) {
        results[k].cpu_ms = 7.0 + static_cast<double>(k);
    }
    in_units_of_floor(results);
    EXPECT_EQ(results[0].times_floor, 1.25);
    EXPECT_EQ(results[1].times_floor, 1.0);
    EXPECT_EQ(results[2].times_floor, 0.5);
    EXPECT_EQ(results[0].cpu_times_floor,
              1.0); // the unit of CPU time is the floor that takes the least of it
    EXPECT_EQ(results[2].cpu_times_floor, 9.0 / 7.0);
}

TEST(Verdicts, FineLevelMustBeBothAccurateAndCheap) {
    SetUpResult result = example();
    ASSERT_EQ(missed(judge(result)), 0U);
    result.techniques[2].times_floor = 8.1;
    result.techniques[3].times_floor = 80.0;
    EXPECT_EQ(missed(judge(result)), 1U);
    result.techniques[2].times_floor = 4.0;
    result.techniques[2].errors[0].geometric_mean_mm = 0.06;
    result.techniques[2].error = summarise(result.techniques[2].errors);
    EXPECT_EQ(missed(judge(result)), 2U); // the finest level misses its own limit too
}

TEST(Verdicts, PackReliefMayMeetTheFineLimit) {
    SetUpResult result = example();
    result.techniques[2].times_floor = 8.1;
    result.techniques[3].times_floor = 80.0;
    ASSERT_EQ(missed(judge(result)), 1U);
    result.techniques.push_back(
        technique("relief192", TechniqueKind::PackRelief, -1, 7.0, {picture_error(0.1, 0.1, 0.04, 9.0)}));
    EXPECT_EQ(missed(judge(result)), 0U);
    result.techniques.back().kind = TechniqueKind::ReliefRaster; // not from the pack
    EXPECT_EQ(missed(judge(result)), 1U);
}

TEST(Verdicts, ReportsUnmetGoalsWithoutFailingTheRun) {
    SetUpResult result = example();
    const auto wishes = [&result] {
        std::vector<LimitVerdict> verdicts = judge(result);
        std::erase_if(verdicts, [](const LimitVerdict& verdict) { return !verdict.wished; });
        return verdicts;
    };
    ASSERT_EQ(wishes().size(), 2U);
    EXPECT_EQ(wishes()[0].found, "mesh 1: 5.00 x");
    EXPECT_FALSE(wishes()[0].held);
    EXPECT_EQ(wishes()[1].found, "no level or relief is as accurate");
    EXPECT_FALSE(wishes()[1].held);
    EXPECT_TRUE(require_limits({&result, 1}));
    EXPECT_NE(lines_of(judge(result)).find("unmet  goal: <= 0.15 % or 0.1 px, <= 0.05 mm at <= 2 x floor"),
              std::string::npos);
    EXPECT_NE(verdicts_csv({&result, 1}, {}).find("mesh 1: 5.00 x\",unmet"), std::string::npos);
    result.techniques.push_back(
        technique("relief192", TechniqueKind::PackRelief, -1, 2.0, {picture_error(0.15, 9.0, 0.05, 99.0)}));
    EXPECT_TRUE(wishes()[0].held);
    EXPECT_FALSE(wishes()[1].held);
    result.techniques.push_back(
        technique("mesh 2", TechniqueKind::PackLevel, 2, 4.0, {picture_error(9.0, 0.05, 0.01, 99.0)}));
    EXPECT_TRUE(wishes()[1].held);
    result.techniques.back().errors.push_back(
        picture_error(9.0, 0.05, 0.0101, 99.0)); // the worst pose counts
    result.techniques.back().error = summarise(result.techniques.back().errors);
    EXPECT_FALSE(wishes()[1].held);
}

TEST(Report, EveryRowHasAsManyFieldsAsTheHeader) {
    SetUpResult result = example();
    result.poses = {BenchPose{}};
    for (const std::string& csv : {summary_csv({&result, 1}), poses_csv({&result, 1})}) {
        std::size_t commas = std::string::npos;
        std::size_t rows = 0;
        for (std::size_t at = 0; at < csv.size(); ++rows) {
            const std::size_t end = csv.find('\n', at);
            const auto count =
                static_cast<std::size_t>(std::count(csv.begin() + static_cast<std::ptrdiff_t>(at),
                                                    csv.begin() + static_cast<std::ptrdiff_t>(end), ','));
            commas = commas == std::string::npos ? count : commas;
            EXPECT_EQ(count, commas) << csv.substr(at, end - at);
            at = end + 1;
        }
        EXPECT_GE(rows, 4U);
    }
}

TEST(Report, LeavesMissingShownErrorsEmpty) {
    SetUpResult result = example();
    result.techniques[1].errors[0].shown = ShownError{0.125, 0.0, 0.0, {}, 0.0};
    result.techniques[1].error = summarise(result.techniques[1].errors);
    const auto json = nlohmann::json::parse(report_json({&result, 1}, "t", {}));
    const auto& techniques = json["set_ups"][0]["techniques"];
    EXPECT_EQ(techniques[1]["worst"]["shown_cover_px"], 0.125);
    EXPECT_TRUE(techniques[2]["worst"]["shown_cover_px"].is_null());
    result.poses = {BenchPose{}};
    const std::string csv = poses_csv({&result, 1});
    EXPECT_NE(csv.find(",0.125000,0.000000,0.000000,0.000000,0.000000,0.000000\n"), std::string::npos) << csv;
    EXPECT_NE(csv.find(",,,,,,\n"), std::string::npos) << csv;
}

} // namespace
} // namespace frustumscreen::bench
