// Tests verdicts on a thousand tables with known truth: a distance reported for 95 of 100 places must hold
// for 93 to 97. A wrong touch, or a wrong corner, must be found.
#include "app/calibration/calibrate_auto.h"
#include "app/calibration/corner_uncertainty.h"
#include "app/calibration/touch_up.h"
#include "tests/calibration/measured_corners.h"
#include "tests/calibration/shipped_crosses.h"
#include "tests/simulators/table/simulated_rests.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <numbers>
#include <string>

namespace frustumscreen::calibration {
namespace {

constexpr double top_m = 0.12;

/// How often the reported distances hold, over tables.
struct Kept {
    double tables = 0.0;
    double usual = 0.0, max = 0.0, worst = 0.0; ///< shares of the places, of the places, and of the tables
    double max_squares = 0.0;
    double mean_mm = 0.0, worst_mm = 0.0, farthest_mm = 0.0; ///< true errors
    double said_max_mm = 0.0, said_worst_mm = 0.0;
    int good = 0, usable = 0, repeat = 0, refused = 0;

    void count(Verdict verdict) {
        good += verdict == Verdict::Good ? 1 : 0;
        usable += verdict == Verdict::Usable ? 1 : 0;
        repeat += verdict == Verdict::Repeat ? 1 : 0;
        refused += verdict == Verdict::Refused ? 1 : 0;
    }
    /// `off_m`: the true error of each place.
    void add(std::span<const double> off_m, const PictureShares& said) {
        double within_usual = 0.0;
        double within_max = 0.0;
        double sum = 0.0;
        double worst_of_table = 0.0;
        for (const double off : off_m) {
            within_usual += off <= said.usual_m ? 1.0 : 0.0;
            within_max += off <= said.max_m ? 1.0 : 0.0;
            sum += off;
            worst_of_table = std::fmax(worst_of_table, off);
        }
        const auto places = static_cast<double>(off_m.size());
        tables += 1.0;
        usual += within_usual / places;
        max += within_max / places;
        max_squares += within_max * within_max / (places * places);
        worst += worst_of_table <= said.worst_m ? 1.0 : 0.0;
        mean_mm += 1e3 * sum / places;
        worst_mm += 1e3 * worst_of_table;
        farthest_mm = std::fmax(farthest_mm, 1e3 * worst_of_table);
        said_max_mm += 1e3 * said.max_m;
        said_worst_mm += 1e3 * said.worst_m;
    }
    [[nodiscard]] double max_share() const { return max / tables; }
    /// Standard deviation of max_share.
    [[nodiscard]] double max_error() const {
        return std::sqrt(std::fmax(0.0, max_squares / tables - max_share() * max_share()) / tables);
    }
    void print(const char* what) const {
        std::printf("%s: %.0f tables, %d good, %d usable, %d repeat, %d refused; off by %.2f mm, worst place "
                    "%.2f mm on "
                    "average, %.2f in one; said are %.2f and %.2f mm\n    places within what 68 / 95 of 100 "
                    "are said to "
                    "be: %.1f %% / %.1f %% (+- %.1f), worst places: %.1f %%\n",
                    what, tables, good, usable, repeat, refused, mean_mm / tables, worst_mm / tables,
                    farthest_mm, said_max_mm / tables, said_worst_mm / tables, 100.0 * usual / tables,
                    100.0 * max_share(), 100.0 * max_error(), 100.0 * worst / tables);
    }
};

std::vector<double> lengths(std::span<const glm::dvec3> offsets) {
    std::vector<double> out;
    for (const glm::dvec3& offset : offsets) {
        out.push_back(glm::length(offset));
    }
    return out;
}

/// Expects 93 to 97 %, plus the chance variation of a few tables.
void expect_kept(const Kept& kept) {
    constexpr double one_in_a_thousand = 3.09;
    ASSERT_GT(kept.tables, 0.0);
    const double chance = kept.tables < 1000.0 ? one_in_a_thousand * kept.max_error() : 0.0;
    EXPECT_GE(kept.max_share(), 0.93 - chance);
    EXPECT_LE(kept.max_share(), 0.97 + chance);
}

/// Touches as a technician makes them: boards whose height differs slightly from the given one, and a sensor
/// height from a ruler.
struct MadeTouches {
    Touches touches;
    TouchSetup setup;
};

MadeTouches made_touches(const simulators::SimulatedTable& table, const std::vector<Cross>& crosses,
                         simulators::SeededNumbers& numbers) {
    constexpr double boards_error = 0.01;
    constexpr double ruler_error_m = 5e-4;
    const double boards = 1.0 + boards_error * numbers.normal();
    std::vector<Cross> true_crosses = crosses;
    for (Cross& cross : true_crosses) {
        cross.block_m *= boards;
    }
    MadeTouches made{touches_of(table, true_crosses, {}, numbers), setup_for(table)};
    for (std::size_t k = 0; k < crosses.size(); ++k) {
        made.touches[k].block_m = crosses[k].block_m;
    }
    *made.setup.sensor_height_m += ruler_error_m * numbers.normal();
    made.setup.top_m = shipped_top_m;
    return made;
}

Kept touched(std::uint64_t tables, const std::vector<Cross>& crosses) {
    Kept kept;
    for (std::uint64_t seed = 1; seed <= tables; ++seed) {
        const simulators::SimulatedTable table = simulators::shipped_table(seed);
        simulators::SeededNumbers numbers(10000 + seed);
        const MadeTouches made = made_touches(table, crosses, numbers);
        const TouchCalibration found = calibrate_touch(made.touches, made.setup);
        kept.count(found.verdict);
        if (found.table) {
            kept.add(lengths(simulators::registration_offsets(table, *found.table, shipped_top_m)),
                     found.uncertainty.shares);
        }
    }
    return kept;
}

Kept rested(std::uint64_t tables) {
    Kept kept;
    for (std::uint64_t seed = 1; seed <= tables; ++seed) {
        const simulators::SimulatedTable table = simulators::some_table(seed);
        simulators::SeededNumbers numbers(20000 + seed);
        simulators::RestPlan plan;
        plan.count = 16;
        AutoSetup setup;
        setup.width = table.truth.pinhole.width;
        setup.height = table.truth.pinhole.height;
        const AutoCalibration found =
            calibrate_auto(simulators::simulated_rests(table, simulators::sheet_with_prop(), plan,
                                                       {3e-4, 2.6e-3, 0.15, 1e-4}, numbers),
                           setup);
        kept.count(found.found.verdict);
        if (found.found.table && found.found.repeat.empty()) {
            kept.add(lengths(simulators::registration_offsets(table, *found.found.table, top_m)),
                     found.found.uncertainty.shares);
        }
    }
    return kept;
}

Kept ruled(std::uint64_t tables, bool distorts) {
    Kept kept;
    for (std::uint64_t seed = 1; seed <= tables; ++seed) {
        simulators::SimulatedTable table = simulators::some_table(seed);
        table.truth.pinhole.lens = distorts ? table.truth.pinhole.lens : geometry::Lens{};
        simulators::SeededNumbers numbers(30000 + seed);
        const geometry::Pinhole& p = table.truth.pinhole;
        const std::vector<MeasuredCorner> corners = measured_corners(table, 0.4, 0.005, numbers);
        const CornerCalibration found = calibrate_corners(corners, p.width, p.height);
        kept.count(found.verdict);
        if (!found.pinhole) {
            continue;
        }
        const CornerUncertainty uncertainty = uncertainty_of(found, corners, top_m);
        CalibratedTable calibrated = table.truth;
        calibrated.pinhole = *found.pinhole;
        calibrated.table_from_projector = found.measured_from_projector;
        std::vector<double> off_m;
        for (const PlaceUncertainty& place : uncertainty.zone) {
            off_m.push_back(glm::distance(simulators::true_light(calibrated, place.pixel, place.height_m),
                                          simulators::true_light(table.truth, place.pixel, place.height_m)));
        }
        kept.add(off_m, uncertainty.picture.shares);
    }
    return kept;
}

TEST(Promises, HoldForTouchesOnTheShippedTable) {
    const Kept kept = touched(60, shipped_crosses(shipped_touches));
    kept.print("touches");
    expect_kept(kept);
    // One right touch in a hundred is doubted. Among 60 sets of 15 touches, 9 are expected to be repeated; more
    // than 17 have a probability of 0.001.
    EXPECT_GE(kept.good + kept.usable, 60 - 17);
}

TEST(Promises, HoldForRests) {
    const Kept kept = rested(12);
    kept.print("rests");
    expect_kept(kept);
}

TEST(Promises, HoldForCorners) {
    const Kept kept = ruled(200, false);
    kept.print("corners");
    expect_kept(kept);
}

TEST(Promises, DISABLED_HoldForTouchesOnAThousandTables) {
    const Kept kept = touched(1000, shipped_crosses(shipped_touches));
    kept.print("the shipped crosses");
    expect_kept(kept);
}

/// Other numbers of crosses, and crosses for a prop that may hang over the table's edge.
TEST(Promises, DISABLED_PrintFiguresOfOtherCrosses) {
    touched(100, shipped_crosses(shipped_touches)).print("the shipped crosses");
    touched(100, crosses_all_over(9)).print("9 crosses all over the picture");
    touched(100, shipped_crosses(9)).print("9 on which the prop stands");
    touched(100, shipped_crosses(12)).print("12");
    touched(100, shipped_crosses(18)).print("18");
    touched(100, crosses_all_over(15)).print("15 crosses all over the picture");
}

TEST(Promises, DISABLED_HoldForRestsOnAThousandTables) {
    const Kept kept = rested(1000);
    kept.print("rests");
    expect_kept(kept);
}

TEST(Promises, DISABLED_HoldForCornersOnAThousandTables) {
    const Kept kept = ruled(1000, false);
    kept.print("corners");
    expect_kept(kept);
    ruled(1000, true).print("corners, a lens that distorts");
}

/// 0 for good, 1 for usable, 2 for all others.
int rank_of(const TouchCalibration& found) {
    return found.verdict == Verdict::Good ? 0 : found.verdict == Verdict::Usable ? 1 : 2;
}

/// Counts of sets with one touch moved by 3 mm along the table.
struct Slips {
    int sets = 0;
    int named = 0;
    int worse = 0;        ///< not named, but the verdict is worse than without the slip
    int false_alarms = 0; ///< not good or usable without a slip
};

Slips slips_of(int sets) {
    const std::vector<Cross> crosses = shipped_crosses(shipped_touches);
    Slips slips;
    slips.sets = sets;
    for (int set = 1; set <= sets; ++set) {
        const auto seed = static_cast<std::uint64_t>(set);
        const simulators::SimulatedTable table = simulators::shipped_table(seed);
        simulators::SeededNumbers numbers(40000 + seed);
        MadeTouches made = made_touches(table, crosses, numbers);
        const TouchCalibration without = calibrate_touch(made.touches, made.setup);
        const std::size_t slipped = numbers.below(made.touches.size());
        const double towards = numbers.between(0.0, 2.0 * std::numbers::pi);
        made.touches[slipped].tracker_from_sensor.translation +=
            glm::inverse(table.truth.table_from_tracker.rotation) *
            glm::dvec3(3e-3 * std::cos(towards), 3e-3 * std::sin(towards), 0.0);
        const TouchCalibration with = calibrate_touch(made.touches, made.setup);
        const bool is_named = std::find(with.repeat.begin(), with.repeat.end(), slipped) != with.repeat.end();
        slips.named += is_named ? 1 : 0;
        slips.worse += !is_named && rank_of(with) > rank_of(without) ? 1 : 0;
        slips.false_alarms += rank_of(without) == 2 ? 1 : 0;
    }
    std::printf("of %d slips of 3 mm %d were named, %d more made the verdict worse; %d sets without one were "
                "not to be kept\n",
                slips.sets, slips.named, slips.worse, slips.false_alarms);
    return slips;
}

/// 95 of 100 are expected; of 40 sets, fewer than 34 have a probability of 0.001.
TEST(Promises, ASlipOfThreeMillimetresIsDetected) {
    const Slips slips = slips_of(40);
    EXPECT_GE(slips.named + slips.worse, 34);
}

TEST(Promises, DISABLED_SlipsAreDetectedOnFourHundredTables) {
    const Slips slips = slips_of(400);
    EXPECT_GE(100 * (slips.named + slips.worse), 95 * slips.sets);
}

/// A bumped projector is corrected by crosses on which the prop stands: seven, and two more if those do not
/// check each other.
TEST(Promises, ATouchUpCorrectsThePictureOnTheShippedTable) {
    int kept = 0;
    int kept_with_more = 0;
    double sum_mm = 0.0;
    constexpr int tables = 8;
    for (std::uint64_t seed = 1; seed <= tables; ++seed) {
        const simulators::SimulatedTable before = simulators::shipped_table(seed);
        simulators::SeededNumbers numbers(60000 + seed);
        simulators::SimulatedTable after = before;
        after.truth.table_from_projector.translation += 8e-3 * numbers.normals();
        TouchModel known = shipped_model();
        known.pinhole = before.truth.pinhole;
        known.projector_from_tracker = before.truth.table_from_projector.inverse();
        const std::vector<Cross> crosses = choose_touch_up_crosses(known, shipped_cross_setup(7), 2);
        ASSERT_LT(overhang_m(known, crosses, *shipped_cross_setup(7).reach_m), 1e-3);
        TouchSetup setup = setup_for(after);
        setup.top_m = shipped_top_m;
        const Touches touches = touches_of(after, crosses, {}, numbers);
        const auto may_be_kept = [](const TouchUp& found) {
            return found.verdict == Verdict::Good || found.verdict == Verdict::Usable;
        };
        const TouchUp seven = touch_up(before.truth, std::span(touches).first(7), setup);
        const TouchUp nine = touch_up(before.truth, touches, setup);
        kept += may_be_kept(seven) ? 1 : 0;
        kept_with_more += may_be_kept(nine) ? 1 : 0;
        ASSERT_TRUE(nine.table) << nine.reason.sentence;
        sum_mm += 1e3 * simulators::registration_error(after, *nine.table, shipped_top_m).mean_m;
    }
    std::printf("of %d touch-ups by seven crosses %d may be kept, with two more %d, off by %.2f mm\n", tables,
                kept, kept_with_more, sum_mm / tables);
    EXPECT_GE(kept_with_more, tables - 1);
    EXPECT_LT(sum_mm / tables, 1.0);
}

/// At each shipped cross the prop stands on the table, also on boards; crosses with overhang are recognised.
TEST(Promises, ThePropStandsOnTheShippedTableAtEachCross) {
    const glm::dvec2 reach_m = *shipped_cross_setup(shipped_touches).reach_m;
    const std::vector<Cross> crosses = shipped_crosses(shipped_touches);
    ASSERT_EQ(crosses.size(), std::size_t{shipped_touches});
    int on_boards = 0;
    for (const Cross& cross : crosses) {
        // 3600 pixels of focal length, from 1.5 m above.
        const double way = (1.5 - cross.block_m) / 3600.0;
        EXPECT_LE(std::abs(cross.pixel.x - 960.0) * way, 0.4 - 0.15);
        EXPECT_LE(std::abs(cross.pixel.y - 600.0) * way, 0.25 - 0.15);
        on_boards += cross.block_m > 0.0 ? 1 : 0;
    }
    EXPECT_GE(on_boards, 5);
    EXPECT_LE(on_boards, 10);
    EXPECT_EQ(overhang_m(shipped_model(), crosses, reach_m), 0.0);
    EXPECT_NEAR(overhang_m(shipped_model(), crosses_all_over(9), reach_m), 0.131,
                5e-3); // as measured by a technician
}

/// A table without room for the prop still has crosses, and the overhang is reported.
TEST(Promises, ReportsTheOverhangOnATooSmallTable) {
    CrossSetup setup = shipped_cross_setup(9);
    setup.reach_m = reach_of({0.8, 0.28}, shipped_base_m);
    const std::vector<Cross> crosses = choose_crosses(shipped_model(), setup);
    EXPECT_NEAR(overhang_m(shipped_model(), crosses, *setup.reach_m), 0.04 + 0.015, 5e-3);
}

/// A technician lays the prop on two more crosses whenever the verdict asks for it. Aiming counts by the pixel: 0.75 of these pixels
/// are half a pixel of a picture of 1280 x 800, and 1.5 are half a pixel of 640 x 400, which is too coarse for some tables.
void expect_a_verdict_that_can_be_kept(int tables) {
    constexpr int max_touches = 30;
    const std::vector<Cross> crosses =
        choose_crosses(shipped_model(), shipped_cross_setup(shipped_touches), max_touches - shipped_touches);
    ASSERT_EQ(crosses.size(), static_cast<std::size_t>(max_touches));
    for (const double pixel : {0.75, 1.5}) {
        int kept = 0, too_few_first = 0, touches_in_all = 0;
        for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(tables); ++seed) {
            const simulators::SimulatedTable table = simulators::shipped_table(seed);
            TouchSetup setup = setup_for(table);
            setup.noise.pixel = pixel;
            setup.top_m = shipped_top_m;
            simulators::SeededNumbers numbers(70000 + seed);
            const Touches all = touches_of(table, crosses, setup.noise, numbers);
            std::size_t count = shipped_touches;
            TouchCalibration found = calibrate_touch(std::span(all).first(count), setup);
            const auto asks_for_more = [&] {
                return found.verdict == Verdict::Repeat && found.repeat.empty();
            };
            too_few_first += asks_for_more() ? 1 : 0;
            for (; asks_for_more() && count + 2 <= all.size(); count += 2) {
                found = calibrate_touch(std::span(all).first(count + 2), setup);
            }
            kept += asks_for_more() || found.verdict == Verdict::Refused ? 0 : 1;
            touches_in_all += static_cast<int>(count);
        }
        std::printf("crosses aimed at within %.2f pixels: of %d tables %d lead to a verdict that names "
                    "touches or can be kept, "
                    "%.1f touches on average; %d asked for more after %d\n",
                    pixel, tables, kept, static_cast<double>(touches_in_all) / tables, too_few_first,
                    shipped_touches);
        EXPECT_GE(kept, pixel < 1.0 ? tables : tables / 2);
    }
}

/// Twelve tables find what forty do where the reported distances are 1.3 times too large: at the coarser pixel none can be kept.
TEST(Promises, MoreCrossesLeadToAVerdictThatCanBeKept) {
    expect_a_verdict_that_can_be_kept(12);
}

TEST(Promises, DISABLED_MoreCrossesLeadToAVerdictOnFortyTables) {
    expect_a_verdict_that_can_be_kept(40);
}

/// One corner, at one of its distances, is moved by 50 mm along the table: nine of ten are refused.
TEST(Promises, AWrongCornerIsRefusedAndNamed) {
    int refused = 0;
    int named = 0;
    constexpr int sets = 200;
    constexpr std::array<const char*, 4> names{"top left", "top right", "bottom right", "bottom left"};
    for (std::uint64_t seed = 1; seed <= sets; ++seed) {
        const simulators::SimulatedTable table = simulators::some_table(seed);
        simulators::SeededNumbers numbers(50000 + seed);
        const geometry::Pinhole& p = table.truth.pinhole;
        std::vector<MeasuredCorner> corners = measured_corners(table, 0.4, 0.003, numbers);
        MeasuredCorner& wrong = corners[numbers.below(corners.size())];
        const double towards = numbers.between(0.0, 2.0 * std::numbers::pi);
        wrong.place_m += glm::dvec3(0.05 * std::cos(towards), 0.05 * std::sin(towards), 0.0);
        const CornerCalibration found = calibrate_corners(corners, p.width, p.height);
        refused += found.verdict == Verdict::Refused ? 1 : 0;
        named +=
            found.reason.sentence.find(names[static_cast<std::size_t>(wrong.corner)]) != std::string::npos
                ? 1
                : 0;
    }
    std::printf("of %d sets with a corner 50 mm aside %d were refused, %d with its name\n", sets, refused,
                named);
    EXPECT_GE(refused, sets * 90 / 100);
    EXPECT_GE(named, sets * 85 / 100);
}

} // namespace
} // namespace frustumscreen::calibration
