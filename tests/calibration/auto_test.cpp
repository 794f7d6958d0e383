// Accuracy of the automatic calibration, from rests of points with known truth: exact without noise, within
// the limits with noise.
#include "app/calibration/calibrate_auto.h"
#include "tests/calibration/wide_priors.h"
#include "tests/simulators/table/simulated_rests.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <functional>

namespace frustumscreen::calibration {
namespace {

constexpr RestNoise no_noise{0.0, 0.0, 0.0, 0.0};
constexpr RestNoise usual_noise{3e-4, 2.6e-3, 0.15, 1e-4};

AutoSetup setup_for(const simulators::SimulatedTable& table) {
    AutoSetup setup;
    setup.width = table.truth.pinhole.width;
    setup.height = table.truth.pinhole.height;
    return setup;
}

TEST(Auto, FindsTheTruthWithoutNoise) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const simulators::SimulatedTable table = simulators::some_table(seed);
        simulators::SeededNumbers numbers(seed);
        AutoSetup setup = setup_for(table);
        setup.priors = wide_priors(); // the priors' means are not the truth
        const AutoCalibration got = calibrate_auto(
            simulators::simulated_rests(table, simulators::sheet_with_prop(), {}, no_noise, numbers), setup);
        ASSERT_TRUE(got.found.table) << seed << ": " << got.found.reason.sentence;
        EXPECT_LT(simulators::registration_error(table, *got.found.table, 0.12).worst_m, 2e-5) << seed;
        EXPECT_LT(simulators::prop_error(table, *got.found.table, got.sensor_from_prop, 0.12).worst_m, 2e-5)
            << seed;
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
    double judged = 0.0;      ///< share of good or usable ones
    double uncertainty = 0.0; ///< error over its expected value, root mean square
};

double ninth_tenth(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() * 9 / 10];
}

/// `print`: the printed sheet's size over its nominal size.
Figures figures_of(const simulators::RestPlan& plan, const simulators::TagCorners& corners,
                   const RestNoise& noise, std::uint64_t seeds, double print = 1.0) {
    std::vector<double> worst;
    std::vector<double> prop_worst;
    Figures figures;
    const double share = 1.0 / static_cast<double>(seeds);
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const simulators::SimulatedTable table = simulators::some_table(seed);
        simulators::SeededNumbers numbers(1000 + seed);
        Rests rests = simulators::simulated_rests(table, corners, plan, noise, numbers);
        for (Rest& rest : rests) {
            for (PropPoint& point : rest.points) {
                point.prop_m /= glm::dvec3(print, print, 1.0); // its nominal size
            }
        }
        const AutoCalibration got = calibrate_auto(rests, setup_for(table));
        if (!got.found.table) {
            std::printf("  seed %d: %s\n", static_cast<int>(seed), got.found.reason.sentence.c_str());
            worst.push_back(1e3);
            prop_worst.push_back(1e3);
            continue;
        }
        const simulators::RegistrationError error =
            simulators::registration_error(table, *got.found.table, 0.12);
        const simulators::RegistrationError prop =
            simulators::prop_error(table, *got.found.table, got.sensor_from_prop, 0.12);
        figures.mean_mm += 1e3 * share * error.mean_m;
        figures.prop_mean_mm += 1e3 * share * prop.mean_m;
        worst.push_back(1e3 * error.worst_m);
        prop_worst.push_back(1e3 * prop.worst_m);
        const Verdict verdict = got.found.verdict;
        if (verdict == Verdict::Good || verdict == Verdict::Usable) {
            figures.judged += share;
        } else {
            std::printf("  seed %d: %s\n", static_cast<int>(seed), got.found.reason.sentence.c_str());
        }
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

// Noise of 0.3 mm and 0.15 degrees a rest; docs/calibration.md has the required limits.
TEST(Auto, ErrorOfSixteenRestsIsWithinItsLimits) {
    const Figures figures = figures_of({16, 4}, simulators::sheet_with_prop(), usual_noise, 20);
    EXPECT_LE(figures.mean_mm, 0.3);
    EXPECT_LE(figures.worst_p90_mm,
              0.95); // the second worst of twenty; the long test requires 0.8 of a hundred
    EXPECT_LE(figures.prop_mean_mm, 0.3);
    EXPECT_GE(figures.judged, 0.95);
    // A mean distance over a root mean square is somewhat below 1.
    EXPECT_GT(figures.uncertainty, 0.6);
    EXPECT_LT(figures.uncertainty, 1.2);
}

TEST(Auto, DISABLED_ErrorsOverAHundredTables) {
    for (const int count : {6, 8, 12, 16, 20}) {
        figures_of({count, count / 4}, simulators::sheet_with_prop(), usual_noise, 100);
    }
    const Figures figures =
        figures_of({16, 4}, simulators::sheet_with_prop(), {3e-4, 2.6e-3, 0.2, 1e-4}, 100);
    EXPECT_LE(figures.mean_mm, 0.3);
    EXPECT_LE(figures.worst_p90_mm, 0.8);
    EXPECT_GE(figures.judged, 0.95);
    figures_of({12, 3}, simulators::sheet_with_prop(), {3e-4, 2.6e-3, 0.5, 1e-4}, 100);
    figures_of({12, 3}, simulators::sheet_with_prop(), usual_noise, 100, 1.002); // printed too large
    figures_of({12, 3, 0.15, {0.0}}, simulators::sheet_with_prop(), usual_noise, 100);
    for (const int count : {12, 20, 30}) {
        figures_of({count, count / 4, 0.0}, simulators::tag_on_top(), usual_noise, 100);
    }
}

/// A fault and the expected result: a reason for refusal, or a verdict that holds.
struct Fault {
    const char* name;
    std::function<void(Rests&, const simulators::SimulatedTable&, simulators::SeededNumbers&)> make;
    const char* refused_for; ///< words of the reason; null: any verdict that holds
};

template <typename Change> void each_point(Rests& rests, Change change) {
    for (Rest& rest : rests) {
        for (PropPoint& point : rest.points) {
            change(point);
        }
    }
}

std::vector<Fault> all_faults() {
    using Table = simulators::SimulatedTable;
    using Numbers = simulators::SeededNumbers;
    return {
        {"none", [](Rests&, const Table&, Numbers&) {}, nullptr},
        {"three of ten points wrong",
         [](Rests& rests, const Table& table, Numbers& numbers) {
             each_point(rests, [&](PropPoint& point) {
                 if (numbers.between(0.0, 1.0) < 0.3) {
                     point.pixel = {numbers.between(0.0, table.truth.pinhole.width),
                                    numbers.between(0.0, table.truth.pinhole.height)};
                 }
             });
         },
         nullptr},
        {"a tag of each rest taken for its neighbour",
         [](Rests& rests, const Table&, Numbers&) {
             for (Rest& rest : rests) {
                 for (std::size_t k = 0; k < 4 && rest.points.size() >= 16; ++k) {
                     std::swap(rest.points[k].pixel, rest.points[k + 4].pixel);
                 }
             }
         },
         nullptr},
        {"one rest moved",
         [](Rests& rests, const Table&, Numbers& numbers) {
             rests[numbers.below(rests.size())].tracker_from_sensor.translation += 0.01 * numbers.normals();
         },
         nullptr},
        {"one on a wrong block",
         [](Rests& rests, const Table&, Numbers&) {
             rests[0].block_m = rests[0].block_m.value_or(0.0) + 0.04;
         },
         nullptr},
        {"metal near",
         [](Rests& rests, const Table&, Numbers& numbers) {
             for (Rest& rest : rests) {
                 rest.tracker_from_sensor.translation += 4e-3 * numbers.normals();
             }
         },
         nullptr},
        {"reports in another order",
         [](Rests& rests, const Table&, Numbers&) {
             for (std::size_t k = 0; k + 1 < rests.size(); ++k) {
                 std::swap(rests[k].tracker_from_sensor, rests[k + 1].tracker_from_sensor);
             }
         },
         "belong to the report of the"},
        {"a board printed from behind",
         [](Rests& rests, const Table&, Numbers&) {
             each_point(rests, [](PropPoint& point) { point.prop_m.x = -point.prop_m.x; });
         },
         "mirrored"},
        {"a board printed 3 % too large",
         [](Rests& rests, const Table&, Numbers&) {
             each_point(rests, [](PropPoint& point) {
                 point.prop_m.x /= 1.03;
                 point.prop_m.y /= 1.03;
             });
         },
         "% too large: print it at 100 %"},
        {"a board printed 1 % too small",
         [](Rests& rests, const Table&, Numbers&) {
             each_point(rests, [](PropPoint& point) {
                 point.prop_m.x /= 0.99;
                 point.prop_m.y /= 0.99;
             });
         },
         "% too small: print it at 100 %"},
        {"mirrored",
         [](Rests& rests, const Table& table, Numbers&) {
             each_point(rests,
                        [&](PropPoint& point) { point.pixel.x = table.truth.pinhole.width - point.pixel.x; });
         },
         "mirrored"},
        {"prop in millimetres",
         [](Rests& rests, const Table&, Numbers&) {
             each_point(rests, [](PropPoint& point) { point.prop_m *= 1000.0; });
         },
         "millimetres"},
        {"prop in inches",
         [](Rests& rests, const Table&, Numbers&) {
             each_point(rests, [](PropPoint& point) { point.prop_m /= 0.0254; });
         },
         "inches"},
        {"tracker in millimetres",
         [](Rests& rests, const Table&, Numbers&) {
             for (Rest& rest : rests) {
                 rest.tracker_from_sensor.translation *= 1000.0;
             }
         },
         "millimetres"},
        {"another order of w, x, y, z",
         [](Rests& rests, const Table&, Numbers&) {
             for (Rest& rest : rests) {
                 const glm::dquat q = rest.tracker_from_sensor.rotation;
                 rest.tracker_from_sensor.rotation = glm::dquat(q.x, q.y, q.z, q.w);
             }
         },
         "rests"},
        {"too few", [](Rests& rests, const Table&, Numbers&) { rests.resize(4); }, "too few"},
        {"points in one line",
         [](Rests& rests, const Table&, Numbers&) {
             for (Rest& rest : rests) {
                 std::erase_if(rest.points, [&](const PropPoint& point) {
                     return point.prop_m.y != rest.points[0].prop_m.y;
                 });
             }
         },
         "line"},
        {"all leaning",
         [](Rests& rests, const Table&, Numbers&) {
             for (Rest& rest : rests) {
                 rest.block_m.reset();
             }
         },
         "table"},
    };
}

void run_faults(std::uint64_t seeds) {
    for (const Fault& fault : all_faults()) {
        int promised = 0;
        int wrong = 0;
        int refused = 0;
        int repeat = 0;
        for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
            const simulators::SimulatedTable table = simulators::some_table(seed);
            simulators::SeededNumbers numbers(4000 + seed);
            Rests rests = simulators::simulated_rests(table, simulators::sheet_with_prop(), {12, 3},
                                                      usual_noise, numbers);
            fault.make(rests, table, numbers);
            const AutoCalibration got = calibrate_auto(rests, setup_for(table));
            const Verdict verdict = got.found.verdict;
            refused += verdict == Verdict::Refused ? 1 : 0;
            repeat += verdict == Verdict::Repeat ? 1 : 0;
            if (verdict == Verdict::Good || verdict == Verdict::Usable) {
                ++promised;
                const double worst_m = simulators::registration_error(table, *got.found.table, 0.12).worst_m;
                wrong += worst_m < 2e-3 ? 0 : 1;
            }
            if (fault.refused_for != nullptr) {
                EXPECT_EQ(verdict, Verdict::Refused) << fault.name << ", seed " << seed;
                EXPECT_NE(got.found.reason.sentence.find(fault.refused_for), std::string::npos)
                    << got.found.reason.sentence;
            }
        }
        std::printf("%-45s %3d sets: %d good or usable, of these %d off by 2 mm; repeat %d; refused %d\n",
                    fault.name, static_cast<int>(seeds), promised, wrong, repeat, refused);
        EXPECT_EQ(wrong, 0) << fault.name;
    }
}

TEST(AutoFaults, VerdictsHoldForEachFault) {
    run_faults(3);
}

TEST(AutoFaults, DISABLED_VerdictsHoldForFortySetsPerFault) {
    run_faults(40);
}

TEST(AutoFaults, AsksForTheSensorHeightIfNoRestLeans) {
    const simulators::SimulatedTable table = simulators::some_table(3);
    simulators::SeededNumbers numbers(3);
    const Rests upright =
        simulators::simulated_rests(table, simulators::sheet_with_prop(), {12, 0}, usual_noise, numbers);
    AutoSetup setup = setup_for(table);
    const AutoCalibration refused = calibrate_auto(upright, setup);
    EXPECT_EQ(refused.found.verdict, Verdict::Refused);
    EXPECT_NE(refused.found.reason.sentence.find("--sensor-height"), std::string::npos)
        << refused.found.reason.sentence;
    setup.sensor_height_m = table.sensor_height_m;
    const AutoCalibration found = calibrate_auto(upright, setup);
    ASSERT_TRUE(found.found.table) << found.found.reason.sentence;
    EXPECT_LT(simulators::registration_error(table, *found.found.table, 0.12).mean_m, 5e-4);
}

TEST(AutoFaults, NamesTheRestThatMoved) {
    const simulators::SimulatedTable table = simulators::some_table(5);
    simulators::SeededNumbers numbers(5);
    Rests rests =
        simulators::simulated_rests(table, simulators::sheet_with_prop(), {12, 3}, usual_noise, numbers);
    rests[7].tracker_from_sensor.translation += glm::dvec3(0.01, -0.01, 0.005);
    const AutoCalibration found = calibrate_auto(rests, setup_for(table));
    EXPECT_EQ(found.found.verdict, Verdict::Repeat);
    EXPECT_EQ(found.found.repeat, std::vector<std::size_t>{7});
    EXPECT_NE(found.found.reason.sentence.find("rest 8 does"), std::string::npos)
        << found.found.reason.sentence;
}

} // namespace
} // namespace frustumscreen::calibration
