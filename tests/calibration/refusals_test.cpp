// Touches that determine nothing are refused, each with its own reason.
#include "tests/calibration/simulated_touches.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>

namespace frustumscreen::calibration {
namespace {

/// A grid of crosses that tests can make degenerate.
std::vector<Cross> grid(const simulators::SimulatedTable& table, double share_u, double share_v) {
    const geometry::Pinhole& p = table.truth.pinhole;
    std::vector<Cross> crosses;
    for (int k = 0; k < 12; ++k) {
        const glm::dvec2 at(k % 4 / 3.0 - 0.5, k / 4 / 2.0 - 0.5);
        crosses.push_back({{p.width * (0.5 + share_u * at.x), p.height * (0.5 + share_v * at.y)},
                           k % 2 == 0 ? 0.0 : 0.1,
                           1.5708 * (k % 3)});
    }
    return crosses;
}

TouchCalibration calibrated(std::uint64_t seed, const std::vector<Cross>& crosses, bool height_known = true) {
    const simulators::SimulatedTable table = simulators::some_table(seed);
    simulators::SeededNumbers numbers(seed);
    TouchSetup setup = setup_for(table);
    if (!height_known) {
        setup.sensor_height_m.reset();
    }
    return calibrate_touch(touches_of(table, crosses, {}, numbers), setup);
}

void expect_refused(const TouchCalibration& found, const std::string& word) {
    EXPECT_EQ(found.verdict, Verdict::Refused) << found.reason.sentence;
    EXPECT_FALSE(found.table);
    EXPECT_NE(found.reason.id.view(), "verdict.none");
    EXPECT_NE(found.reason.sentence.find(word), std::string::npos) << found.reason.sentence;
}

/// One right touch in a hundred must be repeated. Among five grids, fewer than two kept ones have a probability
/// of 0.001.
TEST(Refusals, AcceptsAGrid) {
    int kept = 0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const TouchCalibration found = calibrated(seed, grid(simulators::some_table(seed), 0.9, 0.9));
        EXPECT_NE(found.verdict, Verdict::Refused) << found.reason.sentence;
        kept += found.verdict == Verdict::Good || found.verdict == Verdict::Usable ? 1 : 0;
    }
    EXPECT_GE(kept, 2);
}

TEST(Refusals, EachDegenerateSetHasItsReason) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const simulators::SimulatedTable table = simulators::some_table(seed);
        const std::vector<Cross> usual = grid(table, 0.9, 0.9);

        std::vector<Cross> few(usual.begin(), usual.begin() + 5);
        expect_refused(calibrated(seed, few), "too few");

        std::vector<Cross> again = few;
        again.insert(again.end(), few.begin(), few.end());
        expect_refused(calibrated(seed, again), "different places");

        std::vector<Cross> flat = usual;
        for (Cross& cross : flat) {
            cross.block_m = 0.0;
        }
        expect_refused(calibrated(seed, flat), "one height");

        expect_refused(calibrated(seed, grid(table, 0.15, 0.15)), "too near");
        expect_refused(calibrated(seed, grid(table, 0.9, 0.03)), "one line");

        std::vector<Cross> unturned = usual;
        for (Cross& cross : unturned) {
            cross.yaw_rad = 0.4;
        }
        expect_refused(calibrated(seed, unturned), "turned nearly the same way");
        expect_refused(calibrated(seed, usual, false), "--sensor-height");
    }
}

TEST(Refusals, ReasonNamesAFaultOfAllTouches) {
    struct WrongSet {
        std::string word;
        std::function<void(Touches&, const simulators::SimulatedTable&)> make;
    };
    const auto each = [](Touches& touches, const auto& change) {
        for (Touch& touch : touches) {
            change(touch);
        }
    };
    const std::vector<WrongSet> sets = {
        {"mirrored",
         [&](Touches& touches, const simulators::SimulatedTable& table) {
             each(touches, [&](Touch& touch) { touch.pixel.x = table.truth.pinhole.width - touch.pixel.x; });
         }},
        {"in millimetres or inches",
         [&](Touches& touches, const simulators::SimulatedTable&) {
             each(touches, [](Touch& touch) { touch.tracker_from_sensor.translation *= 1000.0; });
         }},
        {"in millimetres or inches",
         [&](Touches& touches, const simulators::SimulatedTable&) {
             each(touches, [](Touch& touch) { touch.tracker_from_sensor.translation /= 0.0254; });
         }},
        {"a block is",
         [&](Touches& touches, const simulators::SimulatedTable&) {
             each(touches, [](Touch& touch) { touch.block_m *= 1000.0; });
         }},
        {"shares of the picture",
         [&](Touches& touches, const simulators::SimulatedTable& table) {
             each(touches, [&](Touch& touch) {
                 touch.pixel /= glm::dvec2(table.truth.pinhole.width, table.truth.pinhole.height);
             });
         }},
        {"contradict each other",
         [](Touches& touches, const simulators::SimulatedTable&) { // four of twelve, each by 5 cm
             for (std::size_t k = 0; k < 4; ++k) {
                 const double angle = 1.7 * static_cast<double>(k);
                 touches[3 * k].tracker_from_sensor.translation +=
                     0.05 * glm::dvec3(std::cos(angle), std::sin(angle), 0.0);
             }
         }},
    };
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const simulators::SimulatedTable table = simulators::some_table(seed);
        simulators::SeededNumbers numbers(seed);
        const Touches right = touches_of(table, grid(table, 0.9, 0.9), {}, numbers);
        for (const WrongSet& wrong : sets) {
            Touches touches = right;
            wrong.make(touches, table);
            SCOPED_TRACE(fmt::format("seed {}: {}", seed, wrong.word));
            expect_refused(calibrate_touch(touches, setup_for(table)), wrong.word);
        }
    }
}

} // namespace
} // namespace frustumscreen::calibration
