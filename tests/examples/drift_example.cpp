// The drift marks are compared with their places right after the calibration. A shift of three pixels, one
// millimetre each, is a drift of 3 mm.
#include "app/drift/drift_check.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Drift) {
    // example
    drift::DriftReference reference{1280, 720, {}, {}, {}};
    drift::MarkSet set;
    for (const double x_m : {-0.3, 0.3}) {
        for (const double y_m : {-0.2, 0.2}) {
            const glm::dvec2 pixel(640.0 + 1000.0 * x_m, 360.0 - 1000.0 * y_m); // 1 mm a pixel
            reference.marks_m.emplace_back(x_m, y_m);
            reference.marks_px.emplace_back(pixel);
            set.marks_px.emplace_back(pixel + glm::dvec2(3.0, 0.0));
        }
    }
    EXPECT_NEAR(drift::measure_drift(reference, set)->off_m, 0.003, 1e-9);
    // end
}

} // namespace
} // namespace frustumscreen::example
