// Projector, registration and a verdict are computed from touches of projected crosses. Here the tracker's
// frame is the table's, and its sensor is in the prop's bottom.
#include "app/calibration/calibrate_touch.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Calibration) {
    // example
    calibration::Touches touches;
    for (int k = 0; k < 18; ++k) { // 3 x 3 places, on the table and on boards
        const double block_m = k < 9 ? 0.0 : 0.12;
        const double below_m = 1.5 - block_m; // the lens is 1.5 m above the table
        const glm::dvec3 place(0.3 * (k % 3 - 1), 0.2 * (k / 3 % 3 - 1), block_m);
        const glm::dquat turned = glm::angleAxis(1.6 * k, glm::dvec3(0.0, 0.0, 1.0));
        const glm::dvec2 pixel(960.0 + 3600.0 * place.x / below_m, 600.0 - 3600.0 * place.y / below_m);
        touches.push_back({{turned, place}, pixel, block_m});
    }
    const calibration::TouchSetup setup{1920, 1200, 0.0, 0.12, {}, {}}; // picture; heights of sensor and prop
    const calibration::TouchCalibration found = calibration::calibrate_touch(touches, setup);
    EXPECT_EQ(found.verdict, calibration::Verdict::Good) << found.reason.sentence;
    EXPECT_NEAR(found.table->table_from_projector.translation.z, 1.5, 1e-4);
    EXPECT_NEAR(found.table->pinhole.fx, 3600.0, 0.5);
    // end
}

} // namespace
} // namespace frustumscreen::example
