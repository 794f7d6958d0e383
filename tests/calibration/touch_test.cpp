// Accuracy of a calibration by touch: exact without noise, within the limits with noise.
#include "tests/calibration/propagated_touches.h"
#include "tests/calibration/simulated_touches.h"
#include "tests/calibration/wide_priors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

namespace frustumscreen::calibration {
namespace {

TEST(Touch, FindsTheTruthWithoutNoise) {
    ChosenCrosses crosses;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const simulators::SimulatedTable table = simulators::some_table(seed);
        simulators::SeededNumbers numbers(seed);
        TouchSetup setup = setup_for(table);
        setup.priors = wide_priors(); // the priors' means are not the truth
        const TouchCalibration found =
            calibrate_touch(touches_of(table, crosses.of(table, 15), no_noise, numbers), setup);
        ASSERT_TRUE(found.table) << seed << ": " << found.reason.sentence;
        const simulators::RegistrationError error =
            simulators::registration_error(table, *found.table, setup.top_m);
        EXPECT_LT(error.worst_m, 2e-5) << seed;
        EXPECT_LT(found.worst_residual_m, 1e-5) << seed;
        EXPECT_NEAR(found.table->pinhole.fx / table.truth.pinhole.fx, 1.0, 1e-4) << seed;
    }
}

TEST(Touch, UsesTheTableFrameOfTheConventions) {
    ChosenCrosses crosses;
    const simulators::SimulatedTable table = simulators::some_table(5);
    simulators::SeededNumbers numbers(5);
    const TouchCalibration found =
        calibrate_touch(touches_of(table, crosses.of(table, 15), no_noise, numbers), setup_for(table));
    ASSERT_TRUE(found.table);
    // The simulated truth has an independently computed frame; the matrices agree element by element.
    const glm::dmat4 tracker = found.table->table_from_tracker.matrix();
    const glm::dmat4 true_tracker = table.truth.table_from_tracker.matrix();
    for (int column = 0; column < 4; ++column) {
        EXPECT_LT(glm::distance(tracker[column], true_tracker[column]), 2e-3);
    }
    EXPECT_LT(glm::distance(found.table->sensor_offset_m, table.truth.sensor_offset_m), 2e-4);
}

/// With a twentieth of the noise, so that its effects are nearly linear.
TEST(Touch, FitIsOptimalToFirstOrder) {
    constexpr TouchNoise little{3e-4 / 20, 2.6e-3 / 20, 0.5 / 20, 1e-4 / 20};
    ChosenCrosses crosses;
    constexpr std::uint64_t tables = 12;
    std::vector<double> beside; // of each table, over the expected error
    for (std::uint64_t seed = 1; seed <= tables; ++seed) {
        const simulators::SimulatedTable table = simulators::some_table(seed);
        const std::vector<Cross>& chosen = crosses.of(table, seed % 2 == 0 ? 9 : 15);
        simulators::SeededNumbers numbers(4000 + seed);
        const PropagatedTouches best =
            propagated_touches(table, touches_of(table, chosen, no_noise, numbers), little, {}, 0.12);
        TouchSetup setup = setup_for(table);
        setup.noise = little;
        const Touches touches = touches_of(table, chosen, little, numbers);
        const TouchCalibration found = calibrate_touch(touches, setup);
        ASSERT_TRUE(found.table) << seed << ": " << found.reason.sentence;
        if (!found.repeat.empty()) {
            continue; // one looks wrong by chance, and is left out of the fit
        }
        const std::vector<glm::dvec3> offsets = simulators::registration_offsets(table, *found.table, 0.12);
        const Eigen::VectorXd expected = offsets_by(best, table, touches);
        ASSERT_EQ(static_cast<std::size_t>(expected.size()), 3 * offsets.size());
        double sum = 0.0;
        for (std::size_t k = 0; k < offsets.size(); ++k) {
            const Eigen::Vector3d offset(offsets[k].x, offsets[k].y, offsets[k].z);
            sum += (offset - expected.segment<3>(3 * static_cast<Eigen::Index>(k))).squaredNorm();
        }
        beside.push_back(std::sqrt(sum / expected.squaredNorm()));
    }
    ASSERT_GE(beside.size(), tables - 3);
    std::sort(beside.begin(), beside.end());
    EXPECT_LT(beside[beside.size() / 2], 0.01);
    EXPECT_LT(beside.back(), 0.05);
}

constexpr double one_in_a_thousand = 3.09; ///< standard deviations of a normal number, one-sided

struct Figures {
    std::vector<double> mean_square_m2; ///< over the picture, of each table
    std::vector<double> worst_m;        ///< the worst place of each table, ascending
    int judged = 0;                     ///< tables that are good or usable
    double square_of_said = 0.0; ///< mean over the tables: the square of the mean error over the reported one
};

/// Figures for a technician's noise: 0.3 mm, 0.15 degrees and half a pixel.
Figures figures_of(int count, int tables) {
    ChosenCrosses crosses;
    Figures figures;
    for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(tables); ++seed) {
        const simulators::SimulatedTable table = simulators::some_table(seed);
        simulators::SeededNumbers numbers(1000 + seed);
        const TouchCalibration found =
            calibrate_touch(touches_of(table, crosses.of(table, count), {}, numbers), setup_for(table));
        if (!found.table) {
            ADD_FAILURE() << seed << ": " << found.reason.sentence;
            continue;
        }
        const std::vector<glm::dvec3> offsets = simulators::registration_offsets(table, *found.table, 0.12);
        double sum = 0.0;
        double sum_m = 0.0;
        double worst = 0.0;
        for (const glm::dvec3& offset : offsets) {
            sum += glm::dot(offset, offset);
            sum_m += glm::length(offset);
            worst = std::fmax(worst, glm::length(offset));
        }
        const double mean_m = sum_m / static_cast<double>(offsets.size());
        figures.square_of_said += std::pow(mean_m / found.uncertainty.mean_m, 2.0) / tables;
        figures.mean_square_m2.push_back(sum / static_cast<double>(offsets.size()));
        figures.worst_m.push_back(worst);
        figures.judged += found.verdict == Verdict::Good || found.verdict == Verdict::Usable ? 1 : 0;
    }
    std::sort(figures.worst_m.begin(), figures.worst_m.end());
    return figures;
}

/// Errors of the best possible fit of the same crosses on the same tables.
struct Propagated {
    SquareError square;                            ///< mean over the tables
    std::vector<std::vector<double>> worst_places; ///< draws of each table, ascending
};
Propagated propagated_of(int count, int tables) {
    constexpr int draws = 200;
    ChosenCrosses crosses;
    Propagated propagated;
    for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(tables); ++seed) {
        const simulators::SimulatedTable table = simulators::some_table(seed);
        simulators::SeededNumbers numbers(3000 + seed);
        const Touches touches = touches_of(table, crosses.of(table, count), no_noise, numbers);
        const PropagatedTouches each = propagated_touches(table, touches, {}, {}, 0.12);
        const SquareError square = square_error(each);
        propagated.square.mean_m2 += square.mean_m2 / tables;
        propagated.square.variance_m4 += square.variance_m4 / tables / tables;
        propagated.worst_places.push_back(worst_places(each, draws, numbers));
    }
    return propagated;
}

/// Expected number of tables beyond a limit at their worst place, plus this number of standard deviations.
double beyond(const Propagated& propagated, double limit_m, double deviations) {
    double mean = 0.0;
    double variance = 0.0;
    for (const std::vector<double>& worst : propagated.worst_places) {
        const double share =
            static_cast<double>(worst.end() - std::upper_bound(worst.begin(), worst.end(), limit_m)) /
            static_cast<double>(worst.size());
        mean += share;
        variance += share * (1.0 - share);
    }
    return mean + deviations * std::sqrt(variance);
}

/// Limit of the worst place in nine of ten tables.
double worst_place_p90(const Propagated& propagated, double deviations) {
    double limit_m = 1e-3;
    while (beyond(propagated, limit_m, deviations) >
           0.1 * static_cast<double>(propagated.worst_places.size())) {
        limit_m += 1e-5;
    }
    return limit_m;
}

void expect_no_more_than_the_noise_makes(int count, int tables) {
    const Propagated propagated = propagated_of(count, tables);
    const Figures figures = figures_of(count, tables);
    ASSERT_EQ(figures.worst_m.size(), static_cast<std::size_t>(tables));
    double square = 0.0;
    for (const double each : figures.mean_square_m2) {
        square += each / tables;
    }
    const double spread = one_in_a_thousand * std::sqrt(propagated.square.variance_m4);
    EXPECT_LE(square, propagated.square.mean_m2 + spread);
    EXPECT_GE(square, propagated.square.mean_m2 - spread); // otherwise another noise was propagated
    const double p90_m = figures.worst_m[static_cast<std::size_t>(tables * 9 / 10 - 1)];
    std::printf(
        "%d touches: %.3f mm root mean square, of the noise %.3f; worst place in 9 of 10 %.3f, of the "
        "noise %.3f, at most %.3f\n",
        count, 1e3 * std::sqrt(square), 1e3 * std::sqrt(propagated.square.mean_m2), 1e3 * p90_m,
        1e3 * worst_place_p90(propagated, 0.0), 1e3 * worst_place_p90(propagated, one_in_a_thousand));
    EXPECT_LE(p90_m, worst_place_p90(propagated, one_in_a_thousand));
    EXPECT_GE(figures.judged, tables * 95 / 100);
    // The reported uncertainty is that of the errors; a mean distance over a root mean square is somewhat below 1.
    EXPECT_GT(std::sqrt(figures.square_of_said), 0.6);
    EXPECT_LT(std::sqrt(figures.square_of_said), 1.2);
}

TEST(Touch, ErrorOfNineTouchesMatchesTheirNoise) {
    expect_no_more_than_the_noise_makes(9, 40);
}

TEST(Touch, ErrorOfFifteenTouchesMatchesTheirNoise) {
    expect_no_more_than_the_noise_makes(15, 40);
}

TEST(Touch, DISABLED_ErrorsMatchTheNoiseOverAHundredTables) {
    expect_no_more_than_the_noise_makes(9, 100);
    expect_no_more_than_the_noise_makes(15, 100);
}

TEST(Touch, NeedsNoSensorHeightWithThreeTouchesOnASide) {
    ChosenCrosses crosses;
    const simulators::SimulatedTable table = simulators::some_table(7);
    simulators::SeededNumbers numbers(7);
    Touches touches = touches_of(table, crosses.of(table, 9), {}, numbers);
    TouchSetup setup = setup_for(table);
    setup.sensor_height_m.reset();
    const TouchCalibration upright = calibrate_touch(touches, setup);
    EXPECT_EQ(upright.verdict, Verdict::Refused);
    EXPECT_NE(upright.reason.sentence.find("--sensor-height"), std::string::npos) << upright.reason.sentence;
    for (std::size_t k = 0; k < 3; ++k) {
        touches.push_back(
            simulators::simulated_touch(table, {crosses.of(table, 9)[3 * k], 1.5}, {}, numbers));
    }
    const TouchCalibration found = calibrate_touch(touches, setup);
    ASSERT_TRUE(found.table) << found.reason.sentence;
    EXPECT_LT(glm::distance(found.table->sensor_offset_m, table.truth.sensor_offset_m), 2e-3);
    EXPECT_LT(simulators::registration_error(table, *found.table, 0.12).mean_m, 1e-3);
}

} // namespace
} // namespace frustumscreen::calibration
