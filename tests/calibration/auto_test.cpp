// What the automatic calibration is worth, from rests of points whose truth is known: exact without noise, within the limits with it.
#include "app/bench/table/simulated_rests.h"
#include "app/calibration/calibrate_auto.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

namespace frustumscreen {
namespace {

constexpr RestNoise no_noise{0.0, 0.0, 0.0, 0.0};
constexpr RestNoise usual_noise{3e-4, 2.6e-3, 0.15, 1e-4};

AutoSetup setup_for(const SimulatedTable& table) {
    AutoSetup setup;
    setup.width = table.truth.pinhole.width;
    setup.height = table.truth.pinhole.height;
    return setup;
}

TEST(Auto, WithoutNoiseTheTruthIsFound) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const SimulatedTable table = some_table(seed);
        SeededNumbers numbers(seed);
        AutoSetup setup = setup_for(table);
        setup.priors = Priors{}.wider(1e3); // priors are not the truth
        const AutoCalibration got =
            calibrate_auto(simulated_rests(table, sheet_with_prop(), {}, no_noise, numbers), setup);
        ASSERT_TRUE(got.found.table) << seed << ": " << got.found.reason;
        EXPECT_LT(picture_error(table, *got.found.table, 0.12).worst_m, 2e-5) << seed;
        EXPECT_LT(prop_error(table, *got.found.table, got.sensor_from_prop, 0.12).worst_m, 2e-5) << seed;
        EXPECT_LT(got.found.worst_residual_m, 1e-5) << seed;
        EXPECT_NEAR(got.found.table->pinhole.fx / table.truth.pinhole.fx, 1.0, 1e-4) << seed;
        EXPECT_GT(std::abs(glm::dot(got.sensor_from_prop.rotation, table.sensor_from_prop)), 1.0 - 1e-8)
            << seed;
    }
}

struct Figures {
    double mean_mm = 0.0;
    double worst_p90_mm = 0.0;
    double prop_mean_mm = 0.0;
    double prop_worst_p90_mm = 0.0;
    double judged = 0.0;      ///< share that is good or usable
    double uncertainty = 0.0; ///< error over what the calibration expects of it, root mean square
};

double ninth_tenth(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() * 9 / 10];
}

Figures figures_of(const RestPlan& plan, const TagCorners& corners, const RestNoise& noise,
                   std::uint64_t seeds) {
    std::vector<double> worst;
    std::vector<double> prop_worst;
    Figures figures;
    const double share = 1.0 / static_cast<double>(seeds);
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const SimulatedTable table = some_table(seed);
        SeededNumbers numbers(1000 + seed);
        const AutoCalibration got =
            calibrate_auto(simulated_rests(table, corners, plan, noise, numbers), setup_for(table));
        if (!got.found.table) {
            std::printf("  seed %d: %s\n", static_cast<int>(seed), got.found.reason.c_str());
            worst.push_back(1e3);
            prop_worst.push_back(1e3);
            continue;
        }
        const PictureError error = picture_error(table, *got.found.table, 0.12);
        const PictureError prop = prop_error(table, *got.found.table, got.sensor_from_prop, 0.12);
        figures.mean_mm += 1e3 * share * error.mean_m;
        figures.prop_mean_mm += 1e3 * share * prop.mean_m;
        worst.push_back(1e3 * error.worst_m);
        prop_worst.push_back(1e3 * prop.worst_m);
        const Verdict verdict = got.found.verdict;
        figures.judged += verdict == Verdict::Good || verdict == Verdict::Usable ? share : 0.0;
        figures.uncertainty += share * std::pow(error.mean_m / got.found.uncertainty.mean_m, 2.0);
    }
    figures.worst_p90_mm = ninth_tenth(std::move(worst));
    figures.prop_worst_p90_mm = ninth_tenth(std::move(prop_worst));
    figures.uncertainty = std::sqrt(figures.uncertainty);
    std::printf("%2d rests, %2d leaning, %zu points, %.2f px: mean %.3f mm, worst place in 90 of 100 %.3f "
                "mm; over the "
                "prop %.3f and %.3f mm; good or usable %.2f; error over uncertainty %.2f\n",
                plan.count, plan.leaning, corners.size(), noise.pixel, figures.mean_mm, figures.worst_p90_mm,
                figures.prop_mean_mm, figures.prop_worst_p90_mm, figures.judged, figures.uncertainty);
    return figures;
}

TEST(Auto, TheFiguresOfRests) {
    for (const int count : {8, 12, 16, 20, 24}) {
        figures_of({count, count / 4}, sheet_with_prop(), usual_noise, 30);
    }
}

} // namespace
} // namespace frustumscreen
