#include "firmware_host/tracker/pose_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace frustumscreen::tracker {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

PoseSample pose(Nanoseconds time, int station, const glm::dvec3& position_m, double yaw = 0.0) {
    return {MonotonicTime(time), station, position_m, glm::angleAxis(yaw, glm::dvec3(0, 0, 1)), true};
}

TEST(PosePath, InterpolatesItsPosesSmoothly) {
    const std::vector<PoseSample> keys{pose(seconds(1), 1, {0.0, 0.0, 0.0}),
                                       pose(seconds(2), 1, {0.2, -0.1, 0.0}, 0.5 * std::numbers::pi),
                                       pose(seconds(4), 1, {0.2, -0.1, 0.0}, 0.5 * std::numbers::pi)};
    const Result<std::vector<PoseSample>> path = pose_path(keys, milliseconds(10));
    ASSERT_TRUE(path);
    ASSERT_EQ(path->size(), 301U);
    EXPECT_EQ(path->front().position_m, keys[0].position_m);
    EXPECT_EQ((*path)[100].position_m, keys[1].position_m);
    EXPECT_EQ(path->back().position_m, keys[2].position_m);
    // Half way after half the time; the speed in the middle is 15/8 of the mean speed, and the ends are at
    // rest (Flash, Hogan).
    EXPECT_NEAR((*path)[50].position_m.x, 0.1, 1e-12);
    EXPECT_NEAR(2.0 * std::asin((*path)[50].rotation.z), 0.25 * std::numbers::pi, 1e-12);
    EXPECT_NEAR(((*path)[51].position_m.x - (*path)[49].position_m.x) / 0.02, 0.2 * 15.0 / 8.0, 1e-3);
    EXPECT_LT((*path)[1].position_m.x, 1e-5);
    for (std::size_t k = 100; k < path->size(); ++k) {
        EXPECT_EQ((*path)[k].position_m, keys[1].position_m); // at rest
    }
}

TEST(PosePath, SeparatesStationsAndMarksUnknownPoses) {
    std::vector<PoseSample> keys{pose(seconds(0), 1, {0.0, 0.0, 0.0}), pose(seconds(1), 2, {0.0, -0.5, 0.5}),
                                 pose(seconds(2), 1, {0.1, 0.0, 0.0}), pose(seconds(3), 1, {0.1, 0.0, 0.0}),
                                 pose(seconds(3), 2, {0.2, -0.5, 0.5})};
    keys[2].ok = false;
    const Result<std::vector<PoseSample>> path = pose_path(keys, milliseconds(500));
    ASSERT_TRUE(path);
    int heads = 0;
    for (const PoseSample& sample : *path) {
        if (sample.station == head_station) {
            ++heads;
            EXPECT_GE(sample.time, MonotonicTime(seconds(1)));
        } else {
            const bool known =
                sample.time < MonotonicTime(seconds(2)) || sample.time == MonotonicTime(seconds(3));
            EXPECT_EQ(sample.ok, known) << to_seconds(sample.time - MonotonicTime{});
        }
    }
    EXPECT_EQ(heads, 5);
}

TEST(PosePath, ReportsDescendingTimesAndTooManyPeriods) {
    EXPECT_TRUE(pose_path({}, seconds(1))->empty());
    const std::vector<PoseSample> back{pose(seconds(2), 2, {}), pose(seconds(1), 2, {})};
    EXPECT_NE(pose_path(back, seconds(1)).error().message.find("station 2 at 1.000 s follows one at 2.000 s"),
              std::string::npos);
    const std::vector<PoseSample> long_path{pose(seconds(0), 1, {}), pose(seconds(100'000), 1, {})};
    EXPECT_NE(pose_path(long_path, milliseconds(1)).error().message.find("1000000 periods"),
              std::string::npos);
}

} // namespace
} // namespace frustumscreen::tracker
