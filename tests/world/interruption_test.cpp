// Random starts and ends: no pose jumps, a spring keeps its velocity, and steps between change nothing.

#include "app/world/player.h"
#include "tests/world/some_worlds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace frustumscreen::world {
namespace {

struct Press {
    MonotonicTime time;
    std::size_t behaviour = 0;
    bool starts = false;
};

std::vector<Press> presses(unsigned seed, std::size_t behaviours) {
    std::mt19937 random(seed);
    std::vector<Press> all;
    MonotonicTime now = at_s(1.0);
    for (int k = 0; k < 40; ++k) {
        now += Nanoseconds(1 + random() % 900'000'000);
        all.push_back({now, random() % behaviours, random() % 3 != 0});
    }
    return all;
}

void apply(Player& player, const Press& press) {
    press.starts ? player.start(press.behaviour, press.time) : player.end(press.behaviour, press.time);
}

std::vector<Behaviour> all_behaviours() {
    Behaviour around = go_round(); // begins and ends where the chest rests
    for (glm::vec4& value : around.channels[0].curve.values) {
        value.x -= 1.0F;
    }
    return {slide(), open_lid(), around, spring_up(), ring()};
}

/// The largest jump at 2000 starts and ends at random moments.
double largest_jump(const std::vector<Behaviour>& behaviours) {
    double jump = 0.0;
    for (unsigned seed = 1; seed <= 50; ++seed) {
        Player player(chest(), behaviours);
        for (const Press& press : presses(seed, behaviours.size())) {
            const std::vector<CellPose> before = copy(player.step(press.time));
            apply(player, press);
            jump = std::fmax(jump, difference(player.step(press.time), before));
            jump = std::fmax(jump, difference(player.step(press.time + Nanoseconds(100)), before));
        }
    }
    return jump;
}

TEST(Interruption, CausesNoJumpAtAnyMoment) {
    const std::vector<Behaviour> all = all_behaviours();
    EXPECT_LT(largest_jump({all[0], all[1], all[2]}), 2e-6); // what 100 ns and a curve's floats make
    // A spring's swing of 1e-4 of the cell's size counts as none; the lid is scaled by 2.
    EXPECT_LT(largest_jump(all), 2.1e-4);
}

/// Ends that come by themselves are looked at from both sides.
TEST(Interruption, KeepsEachStepBelowTheSpeedLimit) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
        Player player(chest(), all_behaviours());
        std::vector<CellPose> before = copy(player.step(at_s(1.0)));
        MonotonicTime now = at_s(1.0);
        for (const Press& press : presses(seed, 5)) {
            while (now + std::chrono::milliseconds(1) < press.time) {
                now += std::chrono::milliseconds(1);
                const std::vector<CellPose> poses = copy(player.step(now));
                // At 20 units a second, far above what these behaviours do, one step goes 0.02.
                EXPECT_LT(difference(poses, before), 0.02);
                before = poses;
            }
            apply(player, press);
        }
    }
}

/// The chest's X and its speed, from three steps.
struct Seen {
    double x = 0.0, v = 0.0;
};
Seen seen(Player& player, MonotonicTime now) {
    const Nanoseconds h(1000);
    const double a = player.step(now)[0].box_from_geometry[3].x;
    const double b = player.step(now + h)[0].box_from_geometry[3].x;
    return {a, (b - a) / to_seconds(h)};
}

TEST(Interruption, ASpringKeepsItsVelocity) {
    for (const double damping : {1.0, 20.0, 60.0}) {
        Behaviour pulled{.name = "pulled", .stays = true};
        pulled.springs.push_back({.cell = 0,
                                  .axis = {1.0, 0.0, 0.0},
                                  .reach = 1.0,
                                  .stiffness_per_s2 = 100.0,
                                  .damping_per_s = damping});
        Player player(chest(), {pulled});
        MonotonicTime now = at_s(1.0);
        for (int k = 0; k < 40; ++k) {
            const Seen before = seen(player, now);
            now += Nanoseconds(2000);
            player.trigger(0, now);
            const Seen after = seen(player, now);
            EXPECT_NEAR(after.x, before.x, 1e-4);
            // The acceleration is 100 to 200, for some microseconds.
            EXPECT_NEAR(after.v, before.v, 2e-3);
            now += Nanoseconds(73'000'000) + k * Nanoseconds(11'000'000);
        }
    }
}

TEST(Interruption, IntermediateStepsDoNotChangeTheResult) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        Player often(chest(), all_behaviours());
        Player once(chest(), all_behaviours());
        std::mt19937 random(seed + 1000);
        MonotonicTime now = at_s(0.0);
        for (const Press& press : presses(seed, 5)) {
            for (int k = 0; k < 50; ++k) {
                now = std::min(press.time, now + Nanoseconds(random() % 40'000'000));
                (void)often.step(now);
            }
            apply(often, press);
            apply(once, press);
        }
        for (const double later : {0.1, 1.0, 10.0}) {
            const MonotonicTime then = now + Nanoseconds(std::llround(later * 1e9));
            EXPECT_LT(difference(often.step(then), once.step(then)), 1e-12) << seed;
        }
    }
}

TEST(Interruption, OneLongStepEqualsAMillionShortOnes) {
    Player often(chest(), all_behaviours());
    Player once(chest(), all_behaviours());
    for (std::size_t k = 0; k < 5; ++k) {
        often.start(k, at_s(0.0));
        once.start(k, at_s(0.0));
    }
    for (int k = 1; k < 1'000'000; ++k) {
        (void)often.step(MonotonicTime(std::chrono::microseconds(10) * k));
    }
    EXPECT_LT(difference(often.step(at_s(10.0)), once.step(at_s(10.0))), 1e-12);
}

} // namespace
} // namespace frustumscreen::world
