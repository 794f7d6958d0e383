// The prop followed by two trackers at once, as in the exhibit: the visitor's picture while one is lost,
// distorted by metal, and back.
#include "app/tracking/live_tracked_state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace frustumscreen::tracking {
namespace {

constexpr double lever_m = 0.0775;
constexpr double tick_s = 0.001;

/// The two sources' reports over time.
struct Story {
    std::function<geometry::RigidTransform(double)> truth;
    std::function<bool(double)> tracker_sends = [](double) { return true; };
    std::function<glm::dvec3(double)> bent = [](double) { return glm::dvec3(0.0); }; ///< distortion by metal,
                                                                                     ///< metres
    std::function<bool(double)> metal_is_told = [](double) { return false; };
    std::function<bool(double)> tags_seen = [](double) { return true; };
    glm::dvec3 tags_off_m{0.0};
    double length_s = 8.0;
};

struct Told {
    double largest_step_mm = 0.0;               ///< between two pictures, beyond the true motion
    double largest_off_mm = 0.0;                ///< from the truth, outside fades; see `settled`
    std::vector<std::pair<double, bool>> leads; ///< when the tags took (true) and returned the lead
    double last_off_mm = 0.0;
};

geometry::RigidTransform at_rest(double) {
    return {rotation_of({0.0, 0.0, 0.4}), {0.05, -0.02, 0.0}};
}
/// A hand that slides the prop to and fro, at most 0.2 m/s.
geometry::RigidTransform slid(double t_s) {
    return {rotation_of({0.0, 0.0, 0.3 * std::sin(1.1 * t_s)}), {0.1 * std::sin(2.0 * t_s), 0.0, 0.0}};
}

/// A 60 Hz tracker with 18 ms latency, 30 Hz tags with 45 ms, 60 Hz pictures that are lit 33 ms later.
Told told(const Story& story, std::uint64_t seed = 1) {
    LiveTrackedState live({0.0, -0.5, 0.5}, lever_m);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    const auto noisy = [&](geometry::RigidTransform pose) {
        const auto any = [&](double sd) {
            return sd * glm::dvec3(normal(random), normal(random), normal(random));
        };
        return moved(pose, {any(0.0003), any(0.0015)});
    };
    Told told;
    std::optional<geometry::RigidTransform> before;
    double before_s = 0.0;
    const MonotonicTime start(std::chrono::seconds(100));
    const auto time = [&](double s) { return start + Nanoseconds(std::llround(1e9 * s)); };
    int trackers = 0, tags = 0, pictures = 0;
    for (double now = 0.1; now < story.length_s; now += tick_s) {
        for (; trackers / 60.0 + 0.018 < now; ++trackers) {
            const double t = trackers / 60.0;
            if (story.tracker_sends(t)) {
                const geometry::RigidTransform pose = noisy(moved(story.truth(t), {story.bent(t), {}}));
                tracker::PoseSample sample{time(t), tracker::prop_station, pose.translation, pose.rotation,
                                           true};
                live.take(sample);
            }
        }
        for (; tags / 30.0 + 0.045 < now; ++tags) {
            const double t = tags / 30.0;
            if (story.tags_seen(t)) {
                live.take_tags(
                    {time(t), noisy(moved(story.truth(t), {story.tags_off_m, {}})), 0.0004, 0.0007});
            }
        }
        if (pictures / 60.0 > now) {
            continue;
        }
        ++pictures;
        const double lit_s = now + 0.033;
        live.tracker_is(story.metal_is_told(now) ? tracker::TrackerHealth::MetalNear
                                                 : tracker::TrackerHealth::Well);
        const TrackedState tracked_state = live.at(time(lit_s));
        if (told.leads.empty() ? tracked_state.by_tags : told.leads.back().second != tracked_state.by_tags) {
            told.leads.emplace_back(now, tracked_state.by_tags);
        }
        const geometry::RigidTransform truth = story.truth(lit_s);
        told.last_off_mm = 1e3 * slip_m(step_between(truth, tracked_state.table_from_prop), lever_m);
        if (before && now > 1.0) {
            const PoseStep went = step_between(*before, tracked_state.table_from_prop);
            const PoseStep truly = step_between(story.truth(before_s), truth);
            const double step =
                1e3 * slip_m({went.shift_m - truly.shift_m, went.turn_rad - truly.turn_rad}, lever_m);
            told.largest_step_mm = std::fmax(told.largest_step_mm, step);
            told.largest_off_mm = std::fmax(told.largest_off_mm, told.last_off_mm);
        }
        before = tracked_state.table_from_prop;
        before_s = lit_s;
    }
    return told;
}

/// 20 mm/s at 60 pictures per second are 0.33 mm; the filtered noise at rest is far below.
constexpr double max_step_mm = 0.6;

TEST(TwoTrackers, TheTrackerLeadsWhileItIsWell) {
    for (const auto& truth : {at_rest, slid}) {
        EXPECT_TRUE(told({.truth = truth, .tags_off_m = {0.005, 0.0, 0.0}}).leads.empty());
    }
}

TEST(TwoTrackers, TagsTakeOverALostTrackerAndHandItBackWithoutAJump) {
    const Told rest = told({.truth = at_rest,
                            .tracker_sends = [](double t) { return t < 2.0 || t > 5.0; },
                            .tags_off_m = {0.005, 0.0, 0.0}});
    ASSERT_EQ(rest.leads.size(), 2U);
    EXPECT_NEAR(rest.leads[0].first, 2.13, 0.05);
    EXPECT_TRUE(rest.leads[0].second);
    EXPECT_NEAR(rest.leads[1].first, 5.6, 0.15);
    EXPECT_LT(rest.largest_step_mm, max_step_mm);
    EXPECT_LT(rest.largest_off_mm, 6.5); // their disagreement
    EXPECT_LT(rest.last_off_mm, 0.7);
}

TEST(TwoTrackers, TagsFollowAMovingPropIfTheTrackerIsLost) {
    const Story story{.truth = slid, .tracker_sends = [](double t) { return t < 2.0 || t > 5.0; }};
    const Story without{
        .truth = slid, .tracker_sends = story.tracker_sends, .tags_seen = [](double) { return false; }};
    const double all_the_time = told({.truth = slid}).largest_step_mm;
    EXPECT_LT(told(story).largest_off_mm, 30.0);
    EXPECT_GT(told(without).largest_off_mm, 100.0); // it stays where it was lost
    EXPECT_LT(told(story).largest_step_mm, all_the_time + 3.0);
}

/// The field's distortion grows, and the tracker reports it from 3 mm on.
TEST(TwoTrackers, ReportedMetalHandsOverToTheTags) {
    for (const double m_s : {0.0005, 0.001}) {
        const double told_s = 2.0 + 0.003 / m_s;
        const auto bend = [m_s](double t) {
            return m_s * std::fmax(t - 2.0, 0.0) * glm::dvec3(0.8, 0.0, 0.6);
        };
        const Told told_of = told({.truth = at_rest,
                                   .bent = bend,
                                   .metal_is_told = [told_s](double t) { return t > told_s; },
                                   .length_s = 14.0});
        ASSERT_EQ(told_of.leads.size(), 1U);
        EXPECT_NEAR(told_of.leads[0].first, told_s + 0.5, 0.1);
        EXPECT_LT(told_of.largest_step_mm, max_step_mm);
        EXPECT_LT(told_of.largest_off_mm, 5.0); // it grows to 6 and 12
        EXPECT_LT(told_of.last_off_mm, 0.7);
    }
}

TEST(TwoTrackers, IntermittentMetalDoesNotChangeTheLead) {
    const Told often = told({.truth = at_rest,
                             .metal_is_told = [](double t) { return std::fmod(t, 0.6) < 0.3; },
                             .tags_off_m = {0.003, 0.0, 0.0}});
    EXPECT_TRUE(often.leads.empty());
}

/// A hand covers the tags while metal is near: a distorted pose is better than none.
TEST(TwoTrackers, CoveredTagsGiveTheLeadBack) {
    const Told told_of = told({.truth = at_rest,
                               .bent = [](double) { return glm::dvec3(0.005, 0.0, 0.0); },
                               .metal_is_told = [](double t) { return t > 1.5; },
                               .tags_seen = [](double t) { return t < 4.0; }});
    ASSERT_EQ(told_of.leads.size(), 2U);
    EXPECT_NEAR(told_of.leads[1].first, 4.25, 0.1);
    EXPECT_LT(told_of.largest_step_mm, max_step_mm);
}

/// Both are lost: the pose is held, then unknown; the tags find the prop elsewhere and the picture glides
/// there.
TEST(TwoTrackers, FindsThePropElsewhereAfterBothWereLost) {
    const auto truth = [](double t) {
        return geometry::RigidTransform{{1.0, 0.0, 0.0, 0.0}, {t < 3.0 ? 0.0 : 0.1, 0.0, 0.0}};
    };
    const Told told_of = told({.truth = truth,
                               .tracker_sends = [](double t) { return t < 2.0; },
                               .tags_seen = [](double t) { return t < 2.0 || t > 4.5; }});
    EXPECT_LT(told_of.last_off_mm, 0.7);
}

} // namespace
} // namespace frustumscreen::tracking
