// Metal near the tracker: no verdict may promise more than holds, however large the distortion.
#include "tests/calibration/simulated_touches.h"
#include "tests/simulators/table/bent_field.h"

#include <gtest/gtest.h>

#include <cmath>

namespace frustumscreen::calibration {
namespace {

TEST(BentField, TheTrackerWithoutMetalReportsTheTruth) {
    simulators::SeededNumbers numbers(1);
    const simulators::Metal none{{0.3, 0.1, -0.4}, 0.0};
    for (int k = 0; k < 20; ++k) {
        const geometry::RigidTransform pose{numbers.rotation(), 0.5 * numbers.normals()};
        const geometry::RigidTransform said = none.reported(pose);
        EXPECT_LT(glm::distance(said.translation, pose.translation), 1e-12);
        EXPECT_GT(std::abs(glm::dot(said.rotation, pose.rotation)), 1.0 - 1e-12);
    }
}

TEST(BentField, VerdictsHoldInABentField) {
    ChosenCrosses crosses;
    int judged = 0;
    for (const double bend_m : {5e-3, 10e-3, 20e-3}) {
        for (std::uint64_t seed = 1; seed <= 8; ++seed) {
            const simulators::BentTable bent = simulators::bent_table(seed, bend_m);
            simulators::SeededNumbers numbers(4000 + seed);
            Touches touches =
                touches_of(bent.table, crosses.of(bent.table, seed % 4 == 0 ? 15 : 9), {}, numbers);
            for (Touch& touch : touches) {
                touch.tracker_from_sensor = bent.metal.reported(touch.tracker_from_sensor);
            }
            const TouchCalibration found = calibrate_touch(touches, setup_for(bent.table));
            if (found.verdict == Verdict::Good || found.verdict == Verdict::Usable) {
                ++judged;
                const auto reported = [&](const geometry::RigidTransform& pose) {
                    return bent.metal.reported(pose);
                };
                EXPECT_LE(simulators::registration_error(bent.table, *found.table, 0.12, reported).worst_m,
                          found.verdict == Verdict::Good ? 5e-3 : 8e-3) // limits as in faults_test.cpp
                    << "bent by " << bend_m << ", seed " << seed;
            }
        }
    }
    EXPECT_GT(judged, 0) << "a small bend does no harm";
}

} // namespace
} // namespace frustumscreen::calibration
