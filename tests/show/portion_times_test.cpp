// Start times of portions: in the recording's pauses if any are near, otherwise by their share.
#include "app/residency/portion_times.h"

#include <gtest/gtest.h>

using namespace frustumscreen;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

/// Silence of a length, with pauses around given times.
sound::Prompt prompt(double length_s, const std::vector<std::pair<double, double>>& pauses_s) {
    sound::Prompt made;
    made.samples.resize(static_cast<std::size_t>(length_s * sound::sample_rate_hz));
    for (const auto& [begin_s, end_s] : pauses_s) {
        made.marks.push_back({static_cast<std::uint32_t>(begin_s * sound::sample_rate_hz),
                              static_cast<std::uint32_t>(end_s * sound::sample_rate_hz)});
    }
    return made;
}

const std::vector<Nanoseconds> shares{seconds(2), seconds(1), seconds(1)};

void expect_times(const std::vector<Nanoseconds>& times, const std::vector<double>& expected_s) {
    ASSERT_EQ(times.size(), expected_s.size());
    for (std::size_t k = 0; k < times.size(); ++k) {
        EXPECT_NEAR(to_seconds(times[k]), expected_s[k], 1e-3) << k;
    }
}

} // namespace

TEST(PortionTimes, divide_speech_without_pauses_by_the_shares) {
    expect_times(residency::portion_times(shares, prompt(20.0, {})), {0.0, 10.0, 15.0});
    expect_times(residency::portion_times({}, prompt(20.0, {})), {});
    EXPECT_EQ(residency::portion_times(shares, sound::Prompt()).size(), 3U);
}

TEST(PortionTimes, are_moved_to_the_longest_pause_nearby) {
    // A comma at 10 s, the sentence's end at 11 s; the rest is divided again from there.
    expect_times(residency::portion_times(shares, prompt(20.0, {{9.9, 10.1}, {10.7, 11.3}, {15.4, 15.8}})),
                 {0.0, 11.0, 15.6});
    expect_times(residency::portion_times(shares, prompt(20.0, {{3.0, 4.0}, {18.0, 19.0}})),
                 {0.0, 10.0, 15.0});
}

TEST(PortionTimes, ascend_for_any_pauses) {
    for (unsigned seed = 1; seed < 200; ++seed) {
        std::vector<std::pair<double, double>> pauses;
        double at_s = 0.0;
        for (unsigned k = 0; k < seed % 30; ++k) {
            at_s += 0.2 + 0.1 * (seed * (k + 3) % 17);
            pauses.emplace_back(at_s, at_s + 0.05 + 0.02 * (seed * k % 11));
            at_s = pauses.back().second;
        }
        const std::vector<Nanoseconds> many(1 + seed % 9, milliseconds(100 + seed));
        const std::vector<Nanoseconds> times =
            residency::portion_times(many, prompt(std::max(at_s, 1.0), pauses));
        EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
        EXPECT_EQ(times.front(), Nanoseconds(0));
        EXPECT_LE(times.back(), seconds(60));
    }
}
