#include "app/tracking/live_tracked_state.h"

#include <gtest/gtest.h>

namespace frustumscreen::tracking {
namespace {

using std::chrono::milliseconds;

const glm::dvec3 default_eye(0.0, -0.55, 0.5);
constexpr double lever_m = 0.08;
const glm::dvec3 left(-0.3, -0.5, 0.6);
const glm::dvec3 right(0.3, -0.45, 0.4);

SeenHead head(std::uint32_t person, int ms, const glm::dvec3& middle_m) {
    return {MonotonicTime(milliseconds(ms)), person, middle_m, 0.02};
}

MonotonicTime at(int ms) {
    return MonotonicTime(milliseconds(ms));
}

TEST(SeenHead, SetsTheEyeUntilAHeadSensorReports) {
    LiveTrackedState live(default_eye, lever_m);
    EXPECT_EQ(live.at(at(0)).eye_m, default_eye);
    int ms = 1000;
    for (; ms < 2000; ms += 33) {
        EXPECT_TRUE(live.take_visitor(head(1, ms, left)));
        static_cast<void>(live.at(at(ms)));
    }
    TrackedState tracked_state = live.at(at(ms));
    EXPECT_TRUE(tracked_state.head_seen);
    EXPECT_FALSE(tracked_state.head_known);
    EXPECT_LT(glm::distance(tracked_state.eye_m, eye_of_head(left, {0.0, 0.0, lever_m})), 1e-3);
    EXPECT_GT(tracked_state.eye_sd_m, 0.02);
    tracker::PoseSample sensor;
    sensor.station = tracker::head_station;
    sensor.position_m = right;
    for (; ms < 3000; ms += 16) {
        sensor.time = at(ms);
        EXPECT_TRUE(live.take(sensor));
        EXPECT_TRUE(live.take_visitor(head(1, ms, left)));
        tracked_state = live.at(at(ms));
    }
    EXPECT_TRUE(tracked_state.head_known);
    EXPECT_FALSE(tracked_state.head_seen);
    EXPECT_LT(glm::distance(tracked_state.eye_m, right), 1e-3);
}

/// The visitor has left: after a second the picture returns to the default eye, without a jump.
TEST(SeenHead, TheEyeReturnsToTheDefaultWithoutAJump) {
    LiveTrackedState live(default_eye, lever_m);
    glm::dvec3 before = default_eye;
    double farthest = 0.0;
    for (int ms = 1000; ms < 5000; ms += 16) {
        if (ms >= 1200 && ms < 2500) {
            EXPECT_TRUE(live.take_visitor(head(1, ms, left)));
        }
        const TrackedState tracked_state = live.at(at(ms));
        farthest = std::max(farthest, glm::distance(tracked_state.eye_m, before));
        before = tracked_state.eye_m;
    }
    EXPECT_FALSE(live.at(at(5000)).head_seen);
    EXPECT_LT(glm::distance(before, default_eye), 1e-3);
    EXPECT_LT(farthest, 0.04); // 0.4 m within a quarter of a second
}

TEST(SeenHead, TheEyeFollowsTheVisitorNearestToTheProp) {
    LiveTrackedState live(default_eye, lever_m);
    tracker::PoseSample prop;
    const auto step = [&](int ms, double x) {
        prop.time = at(ms);
        prop.position_m = {x, 0.0, 0.0};
        static_cast<void>(live.take(prop)); // a moved prop is not accepted at first
        EXPECT_TRUE(live.take_visitor(head(1, ms, left)));
        EXPECT_TRUE(live.take_visitor(head(2, ms, right)));
        return live.at(at(ms)).eye_m;
    };
    int ms = 1000;
    glm::dvec3 eye(0.0);
    for (; ms < 3000; ms += 16) {
        eye = step(ms, -0.2);
    }
    EXPECT_LT(glm::distance(eye, left), 0.12);
    for (; ms < 5000; ms += 16) {
        eye = step(ms, 0.0); // about equally near: the active visitor must not change
    }
    EXPECT_LT(glm::distance(eye, left), 0.12);
    glm::dvec3 before = eye;
    for (; ms < 8000; ms += 16) {
        eye = step(ms, 0.2);
        EXPECT_LT(glm::distance(eye, before), 0.08) << ms;
        before = eye;
    }
    EXPECT_LT(glm::distance(eye, right), 0.12);
}

TEST(ActiveVisitor, ChangesAtOnceIfTheActiveOneHasLeft) {
    ActiveVisitor active_visitor;
    const glm::dvec3 prop(0.0);
    EXPECT_TRUE(active_visitor.see(head(1, 1000, left), prop));
    EXPECT_FALSE(active_visitor.see(head(2, 1000, {0.7, -0.7, 0.5}), prop));
    EXPECT_FALSE(active_visitor.see(head(2, 1400, {0.7, -0.7, 0.5}), prop));
    EXPECT_EQ(active_visitor.person(), 1U);
    EXPECT_TRUE(active_visitor.see(head(2, 1600, {0.7, -0.7, 0.5}), prop));
    EXPECT_EQ(active_visitor.person(), 2U);
}

TEST(ActiveVisitor, IgnoresAShortStepNearer) {
    ActiveVisitor active_visitor;
    const glm::dvec3 prop(0.0);
    int ms = 1000;
    for (; ms < 4000; ms += 33) {
        static_cast<void>(active_visitor.see(head(1, ms, {0.0, -0.6, 0.5}), prop));
        const bool leans = ms % 1000 < 500;
        static_cast<void>(active_visitor.see(head(2, ms, {0.4, leans ? -0.1 : -0.8, 0.5}), prop));
        EXPECT_EQ(active_visitor.person(), 1U) << ms;
    }
    for (; ms < 5000; ms += 33) {
        static_cast<void>(active_visitor.see(head(1, ms, {0.0, -0.6, 0.5}), prop));
        static_cast<void>(active_visitor.see(head(2, ms, {0.3, -0.1, 0.5}), prop));
    }
    EXPECT_EQ(active_visitor.person(), 2U);
}

} // namespace
} // namespace frustumscreen::tracking
