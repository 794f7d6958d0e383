#include "app/tracking/pose_math.h"
#include "tests/simulators/tags/tag_figures.h"

#include <gtest/gtest.h>

namespace frustumscreen::tags {
namespace {

/// Constant speed to the right, given as a motion; places and noise do not depend on the speed.
simulators::TagCase slid_at(double speed_m_s) {
    simulators::TagCase one;
    one.camera.rolling_ms = 25.0;
    one.motion = [speed_m_s](std::mt19937_64&) -> simulators::PropMotion {
        return [speed_m_s](double t_s) {
            return geometry::RigidTransform{tracking::rotation_of({0.0, 0.0, 0.0}),
                                            {speed_m_s * t_s, 0.0, 0.0}};
        };
    };
    return one;
}

TEST(TagFigures, GrowWithTheMotionOfTheProp) {
    constexpr std::size_t pictures = 2;
    const simulators::TagFigures rest = simulators::measure(slid_at(0.0), pictures, 1);
    const simulators::TagFigures slid = simulators::measure(slid_at(0.3), pictures, 1);
    EXPECT_EQ(rest.trusted, 1.0);
    EXPECT_EQ(slid.trusted, 1.0);
    EXPECT_GT(slid.off_deg[0], 5.0 * rest.off_deg[0]); // the rows are up to 25 ms apart
    EXPECT_LT(slid.worst_mm, 1e3 * 0.3 * 0.025);
}

} // namespace
} // namespace frustumscreen::tags
