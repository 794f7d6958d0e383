// A procedure is a state machine that takes presses, tracker reports and times. Here the prop is laid on
// the only cross, and rests for a second.
#include "app/calibration/procedure/touch_procedure.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, CalibrationProcedure) {
    // example
    using std::chrono::milliseconds;
    const MonotonicTime start{};
    calibration::TouchProcedure procedure(std::vector<calibration::Cross>{{.pixel = {960.0, 600.0}}});
    procedure.step({.now = start, .next = true}); // the button that begins
    EXPECT_EQ(procedure.stage(), calibration::CalibrationStage::Place);
    procedure.step({.now = start, .next = true}); // the prop lies on the cross
    const geometry::RigidTransform tracker_from_sensor{{1.0, 0.0, 0.0, 0.0}, {0.3, 0.1, 0.0}};
    for (int k = 0; k <= 10; ++k) {
        procedure.step({.now = start + k * milliseconds(100), .prop = tracker_from_sensor});
    }
    EXPECT_EQ(procedure.stage(), calibration::CalibrationStage::Solve);
    EXPECT_EQ(procedure.touches().at(0).pixel, glm::dvec2(960.0, 600.0));
    // end
}

} // namespace
} // namespace frustumscreen::example
