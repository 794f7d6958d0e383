// The kept form of a calibrated table: the picture stays in place, seen from the settings' own frame.
#include "app/programs/calibrate/kept_table.h"
#include "tests/calibration/simulated_touches.h"

#include <gtest/gtest.h>

#include <numbers>

namespace frustumscreen::calibration {
namespace {

/// A described projector: its picture's top at the visitor's side, its middle beside the table's.
settings::Settings described() {
    settings::Settings settings;
    settings.projector.table_from_projector.rotation = glm::angleAxis(std::numbers::pi, glm::dvec3(0, 0, 1)) *
                                                       settings.projector.table_from_projector.rotation;
    settings.projector.table_from_projector.translation = {0.05, -0.1, 1.5};
    settings.tracker.registration.eye_in_sensor_m = {0.0, 0.1, 0.0};
    return settings;
}

/// The middle's light and u agree with the settings, and light and tracker turn together.
TEST(KeptTable, LiesInTheFrameOfTheSettings) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const CalibratedTable table = simulators::some_table(seed).truth;
        const settings::Settings settings = described();
        const settings::Calibration kept = programs::kept_table(table, Touches{{}}, settings);
        const auto lit = [&](const glm::dvec2& pixel) {
            const glm::dvec3 ray = kept.table_from_projector.direction(kept.pinhole.ray(pixel));
            return kept.table_from_projector.translation -
                   ray * (kept.table_from_projector.translation.z / ray.z);
        };
        const glm::dvec2 middle = 0.5 * glm::dvec2(kept.pinhole.width, kept.pinhole.height);
        EXPECT_LT(glm::distance(lit(middle), glm::dvec3(0.05, -0.1, 0.0)), 1e-9) << seed;
        const glm::dvec3 u = lit(middle + glm::dvec2(1, 0)) - lit(middle);
        EXPECT_LT(u.x, 0.0) << seed; // the settings' projector is turned by half a turn
        EXPECT_LT(std::abs(u.y), 1e-5 * std::abs(u.x)) << seed;
        const geometry::RigidTransform before =
            table.table_from_projector.inverse() * table.table_from_tracker;
        const geometry::RigidTransform after =
            kept.table_from_projector.inverse() * kept.registration.table_from_tracker;
        EXPECT_LT(glm::distance(before.point({0.1, 0.2, 0.3}), after.point({0.1, 0.2, 0.3})), 1e-12) << seed;
        EXPECT_EQ(kept.registration.eye_in_sensor_m.y, 0.1);
    }
}

/// Sensors that are tilted, and one that hangs upside down; two props of eight lie on a side.
TEST(KeptTable, FindsThePropsPoseInItsSensor) {
    simulators::SeededNumbers numbers(9);
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        simulators::SimulatedTable table = simulators::some_table(seed);
        table.sensor_from_prop = seed == 1 ? glm::dquat(0.0, 1.0, 0.0, 0.0) : numbers.rotation();
        Touches touches;
        for (int k = 0; k < 8; ++k) {
            const glm::dvec2 middle = 0.5 * glm::dvec2(table.truth.pinhole.width, table.truth.pinhole.height);
            touches.push_back(simulators::simulated_touch(table, {{middle, 0.0, 0.7 * k}, k >= 6 ? 1.2 : 0.0},
                                                          no_noise, numbers));
        }
        const geometry::RigidTransform found = programs::sensor_from_prop(table.truth, touches, {});
        EXPECT_EQ(found.translation, table.truth.sensor_offset_m);
        EXPECT_LT(
            glm::distance(found.rotation * glm::dvec3(0, 0, 1), table.sensor_from_prop * glm::dvec3(0, 0, 1)),
            1e-9)
            << seed;
        // So the prop stands upright on the table wherever it was touched.
        for (int k = 0; k < 6; ++k) {
            const geometry::RigidTransform prop = table.truth.table_from_tracker *
                                                  touches[static_cast<std::size_t>(k)].tracker_from_sensor *
                                                  found;
            EXPECT_LT(glm::distance(prop.rotation * glm::dvec3(0, 0, 1), glm::dvec3(0, 0, 1)), 1e-9);
            EXPECT_NEAR(prop.translation.z, 0.0, 1e-9);
        }
    }
}

} // namespace
} // namespace frustumscreen::calibration
