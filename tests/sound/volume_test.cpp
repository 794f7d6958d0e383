#include "firmware_host/sound/volume.h"

#include <gtest/gtest.h>

#include <cmath>

namespace frustumscreen::sound {
namespace {

TEST(Volume, FollowsTheHoursWithARampAtEachStart) {
    const Volume volume{-2.0, {{8.0, 0.0}, {18.0, -6.0}, {22.0, -20.0}}};
    EXPECT_DOUBLE_EQ(gain_db_at(volume, 12.0), -2.0);
    EXPECT_DOUBLE_EQ(gain_db_at(volume, 18.0), -2.0);
    EXPECT_DOUBLE_EQ(gain_db_at(volume, 18.125), -5.0); // half of the ramp
    EXPECT_DOUBLE_EQ(gain_db_at(volume, 18.25), -8.0);
    EXPECT_DOUBLE_EQ(gain_db_at(volume, 21.9), -8.0);
    EXPECT_DOUBLE_EQ(gain_db_at(volume, 23.0), -22.0);
    EXPECT_DOUBLE_EQ(gain_db_at(volume, 3.0), -22.0); // over midnight
    EXPECT_DOUBLE_EQ(gain_db_at(volume, 8.125), -12.0);
}

TEST(Volume, NeverJumpsEvenAtMidnightOrInShortPeriods) {
    const std::vector<Volume> volumes = {
        {0.0, {}},
        {3.0, {{5.0, -10.0}}},
        {0.0, {{0.0, -20.0}, {9.0, 0.0}}},
        {0.0, {{8.0, 0.0}, {23.9, -20.0}}},
        {0.0, {{1.0, 0.0}, {1.1, -20.0}, {1.15, 5.0}, {23.999, -60.0}}},
    };
    for (const Volume& volume : volumes) {
        constexpr double step_h = 1e-4;
        constexpr double steepest = 65.0 / 1e-3; // dB per hour: from one row to the next
        double last = gain_db_at(volume, 0.0);
        for (double hour = step_h; hour < 24.5; hour += step_h) {
            const double gain = gain_db_at(volume, hour);
            ASSERT_LE(std::abs(gain - last), steepest * step_h * 2.1) << hour;
            last = gain;
        }
        EXPECT_DOUBLE_EQ(gain_db_at(volume, 24.0), gain_db_at(volume, 0.0));
        EXPECT_DOUBLE_EQ(gain_db_at(volume, -1.0), gain_db_at(volume, 23.0));
    }
}

} // namespace
} // namespace frustumscreen::sound
