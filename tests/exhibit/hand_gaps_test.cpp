// A prop in the hand whose sensor or tags are covered for 20 ms to 5 s: what is shown of it never jumps, and its light goes
// out and comes back without a flicker.

#include "app/exhibit/idle_pose.h"
#include "app/geometry/prop_shape.h"
#include "app/tracking/live_tracked_state.h"
#include "app/tracking/pose_math.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

namespace frustumscreen::exhibit {
namespace {

constexpr double lever_m = 0.06;
constexpr double picture_hz = 60.0;
constexpr double lost_s = 3.0;

enum class Followed { ByTracker, ByTags, ByBoth };

MonotonicTime time_at(double t_s) {
    return MonotonicTime(std::chrono::seconds(100)) + Nanoseconds(std::llround(1e9 * t_s));
}

/// A hand in six degrees: three swings of its place and three of its turn, each with its own rhythm.
class Hand {
public:
    explicit Hand(std::mt19937_64& random) {
        std::uniform_real_distribution<double> phase(0.0, 6.28), rhythm(1.5, 4.5);
        for (std::size_t k = 0; k < 6; ++k) {
            phase_[k] = phase(random);
            rhythm_[k] = rhythm(random);
        }
    }
    [[nodiscard]] geometry::RigidTransform at(double t_s) const {
        const auto swing = [&](std::size_t k) { return std::sin(rhythm_[k] * t_s + phase_[k]); };
        return {tracking::rotation_of(0.5 * glm::dvec3(swing(3), swing(4), swing(5))),
                {0.08 * swing(0), 0.06 * swing(1), 0.2 + 0.05 * swing(2)}};
    }

private:
    std::array<double, 6> phase_{}, rhythm_{};
};

struct Seen {
    double hand_step_mm = 0.0;  ///< the hand's longest, of a corner, between two pictures
    double shown_step_mm = 0.0; ///< that of the lit picture
    double step_off_mm = 0.0;   ///< the longest before the loss, beyond the hand's own step
    double darkest = 1.0;       ///< of the prop's picture
    double last_off_mm = 0.0;
    geometry::RigidTransform last; ///< the last shown pose
    bool flickers = false;         ///< the light rose before it fell, or fell after it rose
    bool jumps_place = false;      ///< from the prop to the idle place, or back, while it was lit
    bool attracted = false;
    double last_brightness = 0.0;
};

double corner_step_mm(const geometry::PropShape& prop, const geometry::RigidTransform& from,
                      const geometry::RigidTransform& to) {
    double longest = 0.0;
    for (const glm::dvec3& corner : prop.corners) {
        longest = std::fmax(longest, 1e3 * glm::distance(from.point(corner), to.point(corner)));
    }
    return longest;
}

enum class Cover { Gap, Nothing };

/// `cover`: with Nothing the same hand and the same noise, without the gap.
Seen play(Followed followed, double gap_s, std::uint64_t seed, Cover cover = Cover::Gap) {
    std::mt19937_64 random(seed);
    const Hand hand(random);
    const geometry::PropShape prop = geometry::make_cube(2.0 * lever_m);
    std::normal_distribution<double> normal;
    const auto noisy = [&](const geometry::RigidTransform& pose) {
        const auto any = [&](double sd) {
            return sd * glm::dvec3(normal(random), normal(random), normal(random));
        };
        return tracking::moved(pose, {any(0.0003), any(0.0015)});
    };
    tracking::LiveTrackedState live({0.0, -0.5, 0.5}, lever_m);
    IdlePose idle_pose({0.0, 0.0}, false, time_at(0.0), true);
    const auto covered = [&](double from_s, double t_s) {
        return cover == Cover::Gap && t_s >= from_s && t_s < lost_s + gap_s;
    };
    Seen seen;
    std::optional<DrawnPose> before;
    bool rose = false;
    int trackers = 0, tags = 0;
    for (int picture = 1; picture / picture_hz < lost_s + gap_s + 4.0; ++picture) {
        const double now_s = picture / picture_hz;
        for (; followed != Followed::ByTags && trackers / 60.0 + 0.018 <= now_s; ++trackers) {
            const geometry::RigidTransform pose = noisy(hand.at(trackers / 60.0));
            if (!covered(lost_s, trackers / 60.0)) {
                live.take(
                    {time_at(trackers / 60.0), tracker::prop_station, pose.translation, pose.rotation, true});
            }
        }
        // If both follow, a hand hides the tags first, and for longer.
        const double tags_from_s = followed == Followed::ByBoth ? lost_s - 0.3 : lost_s;
        for (; followed != Followed::ByTracker && tags / 30.0 + 0.045 <= now_s; ++tags) {
            const geometry::RigidTransform pose = noisy(hand.at(tags / 30.0));
            if (!covered(tags_from_s, tags / 30.0)) {
                live.take_tags({time_at(tags / 30.0), pose, 0.0004, 0.0007});
            }
        }
        const double lit_s = now_s + 0.017;
        const tracking::TrackedState state = live.at(time_at(lit_s));
        const DrawnPose drawn =
            idle_pose.at(time_at(now_s), state.prop_known, state.prop_age, state.table_from_prop);
        if (before && now_s > 1.5) {
            const double hand_mm = corner_step_mm(prop, hand.at(lit_s - 1.0 / picture_hz), hand.at(lit_s));
            seen.hand_step_mm = std::fmax(seen.hand_step_mm, hand_mm);
            constexpr double dark = 0.004; // a code of 255, in linear light, is darker
            const bool lit = std::fmin(before->brightness, drawn.brightness) > dark;
            const double step_mm = corner_step_mm(prop, before->table_from_prop, drawn.table_from_prop);
            if (before->attracts != drawn.attracts) {
                seen.jumps_place = seen.jumps_place || lit;
            } else if (!drawn.attracts && lit) {
                seen.shown_step_mm = std::fmax(seen.shown_step_mm, step_mm);
                seen.step_off_mm =
                    now_s < lost_s ? std::fmax(seen.step_off_mm, step_mm - hand_mm) : seen.step_off_mm;
            }
            if (before->attracts == drawn.attracts && !drawn.attracts) {
                rose = rose || drawn.brightness > before->brightness;
                seen.flickers = seen.flickers || (rose && drawn.brightness < before->brightness);
                seen.darkest = std::fmin(seen.darkest, drawn.brightness);
            } else {
                rose = false; // a new picture
            }
        }
        seen.attracted = seen.attracted || (drawn.attracts && now_s > 1.5);
        seen.last_off_mm = corner_step_mm(prop, drawn.table_from_prop, hand.at(lit_s));
        seen.last = drawn.table_from_prop;
        seen.last_brightness = drawn.brightness;
        before = drawn;
    }
    return seen;
}

/// Lengths between 20 ms and 5 s, as many short as long ones.
std::vector<double> gaps(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> power(std::log(0.02), std::log(5.0));
    std::vector<double> lengths{0.02, 0.06, 0.2, 0.24, 0.26, 0.9, 1.1, 5.0};
    for (int k = 0; k < 40; ++k) {
        lengths.push_back(std::exp(power(random)));
    }
    return lengths;
}

/// Without a gap too, the picture is off by what the hand's acceleration makes of the time from the latest motion that the
/// filter knows, a sample before the newest one, to the light: half the acceleration times the square of this time.
double max_off_mm(Followed followed) {
    constexpr double swings = 4.5 * 4.5;  // the fastest swings' accelerations, for each metre and radian
    const double place = 0.1118 * swings; // of Hand's three swings of the place, all at their ends
    const double turn = 0.5 * std::numbers::sqrt3 * swings;
    const double corner_m =
        std::sqrt(6.0) * lever_m; // from the middle of the cube's bottom to a corner of its top
    const double interval_s = followed == Followed::ByTags ? 1.0 / 30.0 : 1.0 / 60.0;
    const double latency_s = followed == Followed::ByTags ? 0.045 : 0.018;
    const double ahead_s = latency_s + interval_s + 0.017;
    return 0.5e3 * (place + turn * corner_m) * (ahead_s + interval_s) * (ahead_s + interval_s);
}

class HandGaps : public ::testing::TestWithParam<Followed> {};

TEST_P(HandGaps, NeverMakeTheShownPropJump) {
    const geometry::PropShape cube = geometry::make_cube(2.0 * lever_m);
    double worst = 0.0, worst_gap_s = 0.0;
    std::uint64_t seed = 1;
    for (const double gap_s : gaps(57)) {
        const Seen seen = play(GetParam(), gap_s, seed++);
        // The hand goes on while the picture glides after it, which adds 1 m/s at most at half the cube's height from its
        // middle. A corner is farther out by the root of 3.
        const double allowed_mm =
            seen.hand_step_mm + std::fmax(seen.step_off_mm, 0.0) + 1e3 * std::numbers::sqrt3 / picture_hz;
        EXPECT_LT(seen.shown_step_mm, allowed_mm) << gap_s << " s, seed " << seed - 1;
        EXPECT_FALSE(seen.jumps_place) << gap_s;
        const Seen whole = play(GetParam(), gap_s, seed - 1, Cover::Nothing);
        EXPECT_LT(corner_step_mm(cube, seen.last, whole.last), 0.1)
            << gap_s << ": four seconds later nothing tells of the gap";
        EXPECT_LT(whole.last_off_mm, max_off_mm(GetParam()));
        if (seen.shown_step_mm > worst * seen.hand_step_mm) {
            worst = seen.shown_step_mm / seen.hand_step_mm;
            worst_gap_s = gap_s;
        }
    }
    std::printf("the longest step is %.2f times the hand's longest, after a gap of %.3f s\n", worst,
                worst_gap_s);
}

TEST_P(HandGaps, FadeOutAndInWithoutFlicker) {
    constexpr double out_s = 0.3 + 0.6; // HandFade
    std::uint64_t seed = 100;
    for (const double gap_s : gaps(58)) {
        const Seen seen = play(GetParam(), gap_s, seed++);
        EXPECT_FALSE(seen.flickers) << gap_s << " s, seed " << seed - 1;
        EXPECT_EQ(seen.last_brightness, 1.0) << gap_s;
        if (gap_s < 0.2) {
            EXPECT_EQ(seen.darkest, 1.0) << gap_s;
        }
        if (gap_s > out_s + 0.1) {
            EXPECT_EQ(seen.darkest, 0.0) << gap_s;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Each, HandGaps,
                         ::testing::Values(Followed::ByTracker, Followed::ByTags, Followed::ByBoth));

TEST(HandFade, IsIndependentOfTheFrameRate) {
    for (int ms = 0; ms < 2000; ms += 13) {
        HandFade often, rarely;
        double each = 1.0;
        for (int k = 0; k <= ms; ++k) {
            const double now = often.at(time_at(1e-3 * k), std::chrono::milliseconds(k));
            EXPECT_LE(now, each);
            EXPECT_GT(now, each - 0.0026); // 1.5 / 600 ms
            each = now;
        }
        EXPECT_EQ(rarely.at(time_at(1e-3 * ms), std::chrono::milliseconds(ms)), each) << ms;
        // It comes back from the level that it has reached, at the same speed.
        for (int k = 0; k <= 600; ++k) {
            const double now = often.at(time_at(1e-3 * (ms + k)), std::chrono::milliseconds(0));
            EXPECT_GE(now, each);
            EXPECT_LT(now, each + 0.0026);
            each = now;
        }
        EXPECT_EQ(each, 1.0) << ms;
    }
}

} // namespace
} // namespace frustumscreen::exhibit
