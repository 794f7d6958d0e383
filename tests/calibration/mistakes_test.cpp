// Mistakes that affect all touches at once are found by undoing them one at a time, and named.
#include "tests/calibration/simulated_touches.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace frustumscreen::calibration {
namespace {

struct Spoilt {
    const char* what;
    void (*spoil)(Touches&, const simulators::SimulatedTable&);
    const char* named;
};

void rotate_poses(Touches& touches, std::size_t by) {
    std::vector<geometry::RigidTransform> poses;
    for (const Touch& touch : touches) {
        poses.push_back(touch.tracker_from_sensor);
    }
    std::rotate(poses.begin(), poses.begin() + static_cast<std::ptrdiff_t>(by), poses.end());
    for (std::size_t k = 0; k < touches.size(); ++k) {
        touches[k].tracker_from_sensor = poses[k];
    }
}

TEST(Mistakes, RefusalNamesTheMistake) {
    const std::vector<Spoilt> all{
        {"a mirrored picture",
         [](Touches& touches, const simulators::SimulatedTable& table) {
             for (Touch& touch : touches) {
                 touch.pixel.x = table.truth.pinhole.width - touch.pixel.x;
             }
         },
         "mirrored"},
        {"one cross on",
         [](Touches& touches, const simulators::SimulatedTable&) { rotate_poses(touches, 1); }, "next cross"},
        {"one cross back",
         [](Touches& touches, const simulators::SimulatedTable&) {
             rotate_poses(touches, touches.size() - 1);
         },
         "cross before"},
        {"the opposite order",
         [](Touches& touches, const simulators::SimulatedTable&) {
             const Touches as_made = touches;
             for (std::size_t k = 0; k < touches.size(); ++k) {
                 touches[k].tracker_from_sensor = as_made[touches.size() - 1 - k].tracker_from_sensor;
             }
         },
         "opposite order"},
    };
    ChosenCrosses crosses;
    for (const Spoilt& each : all) {
        int named = 0;
        for (std::uint64_t seed = 1; seed <= 10; ++seed) {
            const simulators::SimulatedTable table = simulators::some_table(seed);
            simulators::SeededNumbers numbers(700 + seed);
            Touches touches = touches_of(table, crosses.of(table, 9), {}, numbers);
            each.spoil(touches, table);
            const TouchCalibration found = calibrate_touch(touches, setup_for(table));
            EXPECT_EQ(found.verdict, Verdict::Refused)
                << each.what << ", table " << seed << ": " << found.reason.sentence;
            named += found.reason.sentence.find(each.named) != std::string::npos ? 1 : 0;
        }
        EXPECT_GE(named, 9) << each.what;
    }
}

} // namespace
} // namespace frustumscreen::calibration
