// Boards whose height differs from the given one: the tracker measures them, and the calibration is as good
// as with correct heights.
#include "tests/calibration/simulated_touches.h"

#include <gtest/gtest.h>

namespace frustumscreen::calibration {
namespace {

constexpr double said_m = 0.12;

/// Touches on boards of height `true_m` that the file gives as `said_m`.
Touches on_boards(const simulators::SimulatedTable& table, std::vector<Cross> crosses, double true_m,
                  simulators::SeededNumbers& numbers) {
    for (Cross& cross : crosses) {
        cross.block_m *= true_m / said_m;
    }
    Touches touches = touches_of(table, crosses, {}, numbers);
    for (Touch& touch : touches) {
        touch.block_m *= said_m / true_m;
    }
    return touches;
}

TEST(Boards, MeasuresBoardsOfADifferentHeight) {
    ChosenCrosses crosses;
    /// The sum of the pictures' errors on twelve tables, with the same noise each time.
    const auto picture_errors_mm = [&](double off_mm) {
        const double true_m = said_m + 1e-3 * off_mm;
        double sum_mm = 0.0;
        for (std::uint64_t seed = 1; seed <= 12; ++seed) {
            const simulators::SimulatedTable table = simulators::some_table(seed);
            simulators::SeededNumbers numbers(300 + seed);
            const TouchCalibration found =
                calibrate_touch(on_boards(table, crosses.of(table, 9), true_m, numbers), setup_for(table));
            if (!found.table || !found.boards) {
                ADD_FAILURE() << off_mm << " mm, table " << seed << ": " << found.reason.sentence;
                continue;
            }
            EXPECT_NEAR(found.boards->found_m, true_m, 4.0 * found.boards->sd_m) << seed;
            EXPECT_LT(found.boards->sd_m, 1e-3) << seed;
            sum_mm += 1e3 * simulators::registration_error(table, *found.table, said_m).mean_m;
        }
        return sum_mm;
    };
    const double right_mm = picture_errors_mm(0.0);
    for (const double off_mm : {-20.0, -2.0, 1.0, 5.0, 10.0}) {
        EXPECT_LT(picture_errors_mm(off_mm), 1.1 * right_mm) << off_mm;
    }
}

TEST(Boards, ReportsTheHeightOnlyIfItDiffers) {
    ChosenCrosses crosses;
    int told_of_right = 0;
    int told_of_wrong = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const simulators::SimulatedTable table = simulators::some_table(seed);
        simulators::SeededNumbers numbers(500 + seed);
        const std::vector<Cross>& chosen = crosses.of(table, 9);
        const TouchCalibration right =
            calibrate_touch(on_boards(table, chosen, said_m, numbers), setup_for(table));
        const TouchCalibration wrong =
            calibrate_touch(on_boards(table, chosen, 0.117, numbers), setup_for(table));
        told_of_right += right.reason.sentence.find("; the boards are 1") != std::string::npos ? 1 : 0;
        told_of_wrong += wrong.reason.sentence.find("; the boards are 11") != std::string::npos ? 1 : 0;
    }
    EXPECT_LE(told_of_right, 1);
    EXPECT_GE(told_of_wrong, 19);
}

TEST(Boards, ReportsNoHeightWithoutBoards) {
    ChosenCrosses crosses;
    const simulators::SimulatedTable table = simulators::some_table(3);
    simulators::SeededNumbers numbers(3);
    std::vector<Cross> flat = crosses.of(table, 15);
    for (Cross& cross : flat) {
        cross.block_m = 0.0;
    }
    EXPECT_FALSE(calibrate_touch(touches_of(table, flat, {}, numbers), setup_for(table)).boards);
}

} // namespace
} // namespace frustumscreen::calibration
