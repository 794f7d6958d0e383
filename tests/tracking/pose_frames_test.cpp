#include "app/tracking/pose_frames.h"

#include <gtest/gtest.h>

namespace frustumscreen::tracking {
namespace {

tracker::PoseSample row(std::int64_t t_us, int station, double x, bool ok = true) {
    tracker::PoseSample sample;
    sample.time = from_microseconds(t_us);
    sample.station = station;
    sample.position_m.x = x;
    sample.ok = ok;
    return sample;
}

TEST(PoseFrames, OneFramePerPropTimeInAscendingOrder) {
    const std::vector<tracker::PoseSample> rows{row(20, 1, 2), row(10, 1, 1), row(20, 1, 9), row(15, 2, 7),
                                                row(30, 1, 3)};
    const auto frames = pose_frames(rows, {0, -1, 1});
    ASSERT_EQ(frames.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(frames[k].time, from_microseconds(static_cast<std::int64_t>(10 * (k + 1))));
        EXPECT_EQ(frames[k].table_from_prop.translation.x, static_cast<double>(k + 1));
        EXPECT_TRUE(frames[k].prop_known);
        EXPECT_EQ(frames[k].eye_m, glm::dvec3(0, -1, 1));
    }
}

TEST(PoseFrames, TheEyeIsTakenFromTheSameTimeInAnyRowOrder) {
    const std::vector<tracker::PoseSample> rows{row(10, 2, 5), row(20, 1, 0), row(10, 1, 0), row(20, 2, 6),
                                                row(20, 3, 8)};
    const auto frames = pose_frames(rows, {0, -1, 1});
    ASSERT_EQ(frames.size(), 2U);
    EXPECT_EQ(frames[0].eye_m.x, 5.0);
    EXPECT_EQ(frames[1].eye_m.x, 6.0);
}

TEST(PoseFrames, IgnoreUnusableRows) {
    const std::vector<tracker::PoseSample> rows{row(10, 1, 1, false), row(20, 1, 2), row(20, 2, 9, false),
                                                row(20, 1, 3, false)};
    const auto frames = pose_frames(rows, {0, -1, 1});
    ASSERT_EQ(frames.size(), 1U);
    EXPECT_EQ(frames[0].table_from_prop.translation.x, 2.0);
    EXPECT_EQ(frames[0].eye_m, glm::dvec3(0, -1, 1));
}

} // namespace
} // namespace frustumscreen::tracking
