// A torch that is laid down, lost, taken and twisted, in simulated time.
#include "app/tracking/live_tracked_state.h"
#include "app/tracking/pose_math.h"
#include "app/tracking/torch_share.h"
#include "app/tracking/torch_twist.h"
#include "tests/render/counted_new.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace frustumscreen::tracking {
namespace {

constexpr double pi = std::numbers::pi;
constexpr Nanoseconds frame = std::chrono::milliseconds(10);

/// At `height_m`, its light descending by so many degrees.
geometry::RigidTransform torch(double height_m, double descends_deg, double x_m = 0.0) {
    // Light along +Y, then tilted down about +X.
    return {rotation_of({-glm::radians(descends_deg), 0.0, 0.0}) * rotation_of({-0.5 * pi, 0.0, 0.0}),
            {x_m, -0.3, height_m}};
}

TEST(TorchHelper, PointsInTheGivenDirection) {
    EXPECT_LT(glm::distance(torch(0.1, 0.0).direction({0, 0, 1}), glm::dvec3(0, 1, 0)), 1e-12);
    EXPECT_LT(glm::distance(torch(0.1, 90.0).direction({0, 0, 1}), glm::dvec3(0, 0, -1)), 1e-12);
}

class Shares {
public:
    double after(double seconds, const std::optional<geometry::RigidTransform>& pose) {
        double share = 0.0;
        for (int k = 0; k < std::lround(seconds * 100.0); ++k) {
            now_ += frame;
            share = share_.update(now_, pose);
        }
        return share;
    }

private:
    TorchShare share_;
    MonotonicTime now_{};
};

TEST(TorchShare, IsZeroUntilTheTorchIsTaken) {
    Shares shares;
    EXPECT_EQ(shares.after(10.0, torch(0.02, 45.0)), 0.0); // it lies, however it points
    EXPECT_EQ(shares.after(0.4, torch(0.02, 45.0, 0.02)), 1.0);
}

TEST(TorchShare, FadesOutWhenLaidDownAndFadesInWhenTaken) {
    Shares shares;
    (void)shares.after(0.1, torch(0.3, 45.0));
    EXPECT_EQ(shares.after(0.5, torch(0.3, 45.0, 0.1)), 1.0);
    EXPECT_EQ(shares.after(2.9, torch(0.02, 5.0)), 1.0);
    const double fading = shares.after(0.5, torch(0.02, 5.0)); // 0.4 s of 0.8
    EXPECT_NEAR(fading, 0.5, 0.05);
    EXPECT_EQ(shares.after(1.0, torch(0.02, 5.0)), 0.0);
    EXPECT_EQ(shares.after(5.0, torch(0.02, 5.0, 0.01)), 0.0); // knocked, not taken
    const double coming = shares.after(0.15, torch(0.05, 20.0));
    EXPECT_NEAR(coming, 0.5, 0.06);
    EXPECT_EQ(shares.after(0.3, torch(0.1, 40.0)), 1.0);
}

TEST(TorchShare, StaysWhileATorchPointsDownWithoutMoving) {
    Shares shares;
    (void)shares.after(0.1, torch(0.3, 45.0));
    EXPECT_EQ(shares.after(60.0, torch(0.3, 45.0, 0.1)), 1.0);
}

TEST(TorchShare, StaysWhileAHandHoldsItStillPointingAcross) {
    TorchShare share;
    MonotonicTime now{};
    double least = 1.0;
    (void)share.update(now, torch(0.02, 10.0)); // it lies, and is taken
    for (int k = 0; k < 3000; ++k) {
        now += frame;
        const double t = 0.01 * k;
        const double drift_m = 0.012 * std::sin(2.0 * pi * 0.3 * t); // of a hand in the air, in three seconds
        const double s = share.update(now, torch(0.25, 10.0, drift_m));
        least = k > 300 ? std::fmin(least, s) : least;
    }
    EXPECT_EQ(least, 1.0);
}

TEST(TorchShare, FadesOutIfTheTorchIsLostOrInItsHolder) {
    for (const std::optional<geometry::RigidTransform>& away :
         {std::optional<geometry::RigidTransform>{}, std::optional(torch(-0.05, 90.0))}) {
        Shares shares;
        (void)shares.after(0.1, torch(0.3, 45.0));
        EXPECT_EQ(shares.after(0.5, torch(0.3, 45.0, 0.1)), 1.0);
        EXPECT_NEAR(shares.after(0.4, away), 0.5, 0.02);
        EXPECT_EQ(shares.after(0.5, away), 0.0);
        EXPECT_EQ(shares.after(0.5, torch(0.3, 45.0, 0.1)), 1.0);
    }
}

TEST(TorchShare, NeverJumps) {
    TorchShare share;
    MonotonicTime now{};
    double before = 0.0;
    for (int k = 0; k < 4000; ++k) {
        now += frame;
        const bool known = k % 700 < 600;
        const double x = k % 500 < 250 ? 0.001 * (k % 250) : 0.0;
        const double s = share.update(now, known ? std::optional(torch(0.1, 10.0, x)) : std::nullopt);
        EXPECT_LE(std::fabs(s - before), 1.5 * 0.01 / TorchShare::comes_s + 1e-12);
        before = s;
    }
}

constexpr TwistBounds bounds{.usual_rad = 0.5, .min_rad = 0.125, .max_rad = 1.0};

glm::dquat twisted(const glm::dquat& from, double rad) {
    return from * rotation_of({0.0, 0.0, rad});
}

TEST(TorchTwist, DoublesAndHalvesTheOpeningBeyondTheDeadBand) {
    const glm::dquat held = rotation_of({1.0, -0.7, 0.3});
    TorchTwist twist(bounds);
    twist.begin(held);
    EXPECT_EQ(twist.follow(held), 0.5);
    EXPECT_EQ(twist.follow(twisted(held, 0.99 * TorchTwist::dead_rad)), 0.5);
    EXPECT_EQ(twist.follow(twisted(held, -0.99 * TorchTwist::dead_rad)), 0.5);
    EXPECT_NEAR(twist.follow(twisted(held, TorchTwist::dead_rad + 0.5 * TorchTwist::doubles_rad)),
                0.5 * std::sqrt(2.0), 1e-9);
    // Back through the dead band, then on to half of the usual one.
    EXPECT_NEAR(twist.follow(twisted(held, -TorchTwist::dead_rad - TorchTwist::doubles_rad)), 0.25, 1e-9);
}

TEST(TorchTwist, ReversesAtOnceFromItsBounds) {
    const glm::dquat held(1.0, 0.0, 0.0, 0.0);
    TorchTwist twist(bounds);
    twist.begin(held);
    for (double at = 0.0; at < 3.0; at += 0.1) { // far beyond the widest
        (void)twist.follow(twisted(held, at));
    }
    EXPECT_EQ(twist.opening_rad(), 1.0);
    const double back = 3.0 - 2.0 * TorchTwist::dead_rad - TorchTwist::doubles_rad;
    EXPECT_NEAR(twist.follow(twisted(held, back)), 0.5, 0.1);
}

/// Pointing about in circles and coming back is no twist; adding up the turns about the axis would give some.
TEST(TorchTwist, DoesNotDriftWhileTheHandPointsAbout) {
    const glm::dquat held = rotation_of({2.0, 0.4, 0.0});
    TorchTwist twist(bounds);
    twist.begin(held);
    double summed = 0.0;
    glm::dquat last = held;
    for (int k = 0; k <= 20 * 360; ++k) {
        const double angle = glm::radians(static_cast<double>(k));
        const double out = 0.7 * std::fmin(1.0, std::fmin(k, 20 * 360 - k) / 90.0);
        const glm::dquat now = held * rotation_of({out * std::cos(angle), out * std::sin(angle), 0.0});
        summed += rotation_vector(glm::conjugate(last) * now).z;
        last = now;
        EXPECT_EQ(twist.follow(now), 0.5) << k;
    }
    EXPECT_GT(std::fabs(summed), 20.0); // rad: what a sum would have made of it
}

TEST(TorchTwist, ContinuesThroughFullTurnsAndHoldsIfUndefined) {
    const TwistBounds wide{.usual_rad = 0.5, .min_rad = 1e-3, .max_rad = 3.0};
    const glm::dquat held(1.0, 0.0, 0.0, 0.0);
    TorchTwist twist(wide);
    twist.begin(held);
    double before = 0.5;
    for (double at = 0.0; at > -6.0; at -= 0.1) {
        const double opening = twist.follow(twisted(held, at));
        EXPECT_LE(opening, before);
        before = opening;
    }
    EXPECT_NEAR(before, 0.5 * std::exp2((-5.9 + TorchTwist::dead_rad) / TorchTwist::doubles_rad), 1e-3);
    (void)twist.follow(rotation_of({pi, 0.0, 0.0})); // points the other way round: no twist is defined
    EXPECT_EQ(twist.opening_rad(), before);
}

tracker::PoseSample sample_of(const geometry::RigidTransform& pose, MonotonicTime time, int station) {
    return {.time = time, .station = station, .position_m = pose.translation, .rotation = pose.rotation};
}

/// Waves the torch of `station` for a second.
TrackedState waved(LiveTrackedState& state, int station) {
    MonotonicTime now{};
    TrackedState at;
    for (int k = 0; k < 120; ++k) {
        now += std::chrono::microseconds(8333);
        EXPECT_TRUE(state.take(sample_of(torch(0.3, 40.0, 0.001 * k), now, station)));
        at = state.at(now);
    }
    return at;
}

TEST(LiveTrackedTorch, IsStationThreeIfEnabled) {
    LiveTrackedState with({0.0, -0.5, 0.5}, 0.06, {}, PropMotion::OnTable, {.tracker = true});
    const TrackedState state = waved(with, tracker::torch_station);
    EXPECT_EQ(state.torches[0].share, 1.0);
    EXPECT_EQ(state.torches[0].presence, TorchPresence::InHand);
    EXPECT_EQ(state.torches[1].share, 0.0);
    EXPECT_EQ(state.torches[1].presence, TorchPresence::Lost);
    EXPECT_NEAR(state.torches[0].table_from_torch.translation.x, 0.119, 0.005);
    EXPECT_FALSE(state.prop_known);

    LiveTrackedState without({0.0, -0.5, 0.5}, 0.06);
    EXPECT_EQ(waved(without, tracker::torch_station).torches[0].share, 0.0);
    LiveTrackedState other({0.0, -0.5, 0.5}, 0.06, {}, PropMotion::OnTable, {.tracker = true});
    EXPECT_EQ(waved(other, 4).torches[0].share, 0.0);
}

TEST(LiveTrackedTorch, FollowsALampSeenByTheCamera) {
    LiveTrackedState state({0.0, -0.5, 0.5}, 0.06, {}, PropMotion::OnTable, {.camera = true});
    MonotonicTime now{};
    TrackedState at;
    for (int k = 0; k < 60; ++k) {
        now += std::chrono::milliseconds(33);
        EXPECT_TRUE(state.take_lamp({.time = now,
                                     .table_from_prop = torch(0.3, 40.0, 0.002 * k),
                                     .place_sd_m = 0.003,
                                     .turn_sd_rad = 0.02}));
        at = state.at(now);
    }
    EXPECT_EQ(at.torches[1].share, 1.0);
    EXPECT_EQ(at.torches[0].share, 0.0);
    EXPECT_NEAR(at.torches[1].table_from_torch.translation.x, 0.118, 0.02);
    // Lost: it goes softly, and the prop is not concerned.
    for (int k = 0; k < 200; ++k) {
        now += frame;
        at = state.at(now);
    }
    EXPECT_EQ(at.torches[1].share, 0.0);
}

TEST(LiveTrackedTorch, AllocatesNothing) {
    LiveTrackedState state({0.0, -0.5, 0.5}, 0.06, {}, PropMotion::OnTable,
                           {.tracker = true, .camera = true});
    MonotonicTime now{};
    const long before = synthetic::allocations_so_far();
    for (int k = 0; k < 500; ++k) {
        now += frame;
        (void)state.take(sample_of(torch(0.3, 40.0, 0.001 * (k % 100)), now, tracker::torch_station));
        (void)state.take_lamp(
            {.time = now, .table_from_prop = torch(0.3, 40.0), .place_sd_m = 0.0, .turn_sd_rad = 0.0});
        (void)state.at(now);
    }
    EXPECT_EQ(synthetic::allocations_so_far(), before);
}

TEST(TrackedStateTracker, UsesTheTorchPoseUnfiltered) {
    TrackedStateTracker state({0.0, -0.5, 0.5});
    const MonotonicTime now{std::chrono::seconds(5)};
    EXPECT_TRUE(state.take(sample_of(torch(0.3, 40.0), now, tracker::torch_station)));
    EXPECT_EQ(state.at(now).torches[0].share, 1.0);
    EXPECT_EQ(state.at(now).torches[0].table_from_torch.translation, torch(0.3, 40.0).translation);
    EXPECT_EQ(state.at(now + std::chrono::seconds(1)).torches[0].share, 0.0);
}

} // namespace
} // namespace frustumscreen::tracking
