// Objects that are taken into the prop and put back, at any rhythm of frames and with any changes on the way.

#include "app/geometry/rotation_angle.h"
#include "app/room/taking.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace frustumscreen::room {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr MonotonicTime start{std::chrono::hours(30)};
constexpr double prop_size_m = 0.11;

/// Four objects: a vase, a chest that turns and sways, and two horses; artifacts 0, 1 and 2.
std::vector<Object> objects() {
    std::vector<Object> all(4);
    all[0].place_m = {-0.6, 1.6, -0.2};
    all[0].size_m = 0.5;
    all[0].turn_deg = 170.0;
    all[1].place_m = {0.5, 1.9, -0.3};
    all[1].size_m = 0.4;
    all[1].motion = {.turns_per_minute = 12.0, .sway_m = {0.1, 0.0, 0.02}, .sway_s = 4.0};
    all[2].place_m = {0.9, 2.4, 0.1};
    all[2].size_m = 0.3;
    all[3].place_m = {0.3, 1.2, 0.0};
    all[3].size_m = 0.2;
    return all;
}
constexpr std::array<TakeableObject, 4> takeable{
    {{0, 0, prop_size_m}, {1, 1, prop_size_m}, {2, 2, prop_size_m}, {3, 2, prop_size_m}}};

Taking taking() {
    Taking made(objects(), start);
    made.set_takeable(takeable);
    return made;
}

/// A hand that moves and turns the prop, a function of the time.
geometry::RigidTransform prop_at(MonotonicTime now) {
    const double t = to_seconds(now - start);
    return {glm::angleAxis(0.9 * std::sin(1.3 * t), glm::normalize(glm::dvec3(0.2, 0.3, 1.0))),
            {0.08 * std::sin(0.9 * t), -0.1 + 0.05 * std::cos(1.7 * t), 0.12 + 0.03 * std::sin(2.1 * t)}};
}

struct Choice {
    MonotonicTime at;
    std::optional<std::size_t> artifact;
};

/// The exhibit's decision: the artifact in the prop changes through darkness, 0.25 s each way.
struct Visit {
    std::vector<Choice> choices; ///< in order; those for an artifact are 0.5 s apart
    [[nodiscard]] TakingInput at(MonotonicTime now) const {
        TakingInput input{.now = now,
                          .chosen = std::nullopt,
                          .shown = 0,
                          .shown_light = 1.0,
                          .table_from_prop = prop_at(now),
                          .idle = false,
                          .before = std::nullopt};
        std::size_t goal = 0;
        for (const Choice& choice : choices) {
            if (choice.at > now) {
                break;
            }
            input.chosen = choice.artifact;
            if (!choice.artifact || *choice.artifact == goal) {
                continue;
            }
            const double since_s = to_seconds(now - choice.at);
            input.shown = since_s < 0.25 ? goal : *choice.artifact;
            input.shown_light = std::min(1.0, std::abs(since_s - 0.25) / 0.25);
            goal = *choice.artifact;
        }
        return input;
    }
};

const TakenPose* find(const Taking& taking, std::size_t object) {
    const auto found = std::find_if(taking.poses().begin(), taking.poses().end(),
                                    [&](const TakenPose& pose) { return pose.object == object; });
    return found != taking.poses().end() ? &*found : nullptr;
}

/// As the screen shows it, in its place or not.
TakenPose seen(const Taking& taking, std::size_t object, MonotonicTime now) {
    if (const TakenPose* const pose = find(taking, object)) {
        return *pose;
    }
    const Object& at_home = taking.objects()[object];
    return {object, table_from_object(at_home, taking.seconds(now)), at_home.size_m, 1.0};
}

std::vector<TakenPose> all_seen(const Taking& taking, MonotonicTime now) {
    std::vector<TakenPose> all;
    for (std::size_t k = 0; k < taking.objects().size(); ++k) {
        all.push_back(seen(taking, k, now));
    }
    return all;
}

Visit some_visit(std::mt19937_64& random, int choices, milliseconds length) {
    std::vector<MonotonicTime> times;
    for (int k = 0; k < choices; ++k) {
        times.push_back(start + microseconds(random() % static_cast<std::uint64_t>(1000 * length.count())));
    }
    std::sort(times.begin(), times.end());
    Visit visit;
    for (const MonotonicTime at : times) {
        const bool apart = visit.choices.empty() || at - visit.choices.back().at >= milliseconds(500);
        if (apart) {
            visit.choices.push_back(
                {at, random() % 4 == 0 ? std::nullopt : std::optional<std::size_t>(random() % 3)});
        }
    }
    return visit;
}

/// Steps the visit at these and other times, up to `until`.
template <typename Between>
void run(Taking& taking, const Visit& visit, MonotonicTime until, const Between& between) {
    std::vector<MonotonicTime> times{until};
    for (const Choice& choice : visit.choices) {
        times.push_back(choice.at);
        times.push_back(choice.at + milliseconds(250)); // the prop's picture is dark
    }
    for (MonotonicTime now = start; now < until; now += between()) {
        times.push_back(now);
    }
    std::sort(times.begin(), times.end());
    for (const MonotonicTime now : times) {
        if (now <= until) {
            taking.step(visit.at(now));
        }
    }
}

TEST(Taking, MovesAnObjectIntoThePropAndFadesItToItsArtifact) {
    Taking made = taking();
    const Visit visit{{{start, 0}}};
    made.step(visit.at(start));
    EXPECT_TRUE(made.moves());
    EXPECT_EQ(made.prop_share(), 0.0);
    const auto exact_way = [](double t) { return 1.0 - (1.0 + 5.5 * t) * std::exp(-5.5 * t); };
    for (const double t : {0.1, 0.3, 0.5, 0.7, 0.9, 1.2}) {
        const MonotonicTime now = start + microseconds(static_cast<std::int64_t>(1e6 * t));
        made.step(visit.at(now));
        const double part = std::clamp((exact_way(t) - 0.85) / 0.15, 0.0, 1.0);
        EXPECT_NEAR(made.prop_share(), part * part * (3.0 - 2.0 * part), 1e-12) << t;
        const TakenPose pose = seen(made, 0, now);
        EXPECT_NEAR(pose.opacity, 1.0 - made.prop_share(), 1e-15);
        if (part > 0.0) { // while it hands over, it stands where the prop is
            EXPECT_NEAR(glm::distance(pose.table_from_object.translation, prop_at(now).translation), 0.0,
                        1e-15);
            EXPECT_NEAR(pose.size_m, prop_size_m, 1e-15);
        }
    }
    made.step(visit.at(start + std::chrono::seconds(1)));
    EXPECT_GT(made.prop_share(), 0.9);
    const MonotonicTime later = start + std::chrono::seconds(4);
    made.step(visit.at(later));
    EXPECT_FALSE(made.moves());
    EXPECT_EQ(made.prop_share(), 1.0);
    EXPECT_EQ(seen(made, 0, later).opacity, 0.0);
    EXPECT_NEAR(
        geometry::rotation_angle(seen(made, 0, later).table_from_object.rotation, prop_at(later).rotation),
        0.0, 1e-7);
}

TEST(Taking, ReturnsAnObjectExactlyToItsPlace) {
    Taking made = taking();
    Visit visit{{{start, 1}, {start + milliseconds(3000), std::nullopt}}};
    made.step(visit.at(start));
    made.step(visit.at(start + milliseconds(2000)));
    EXPECT_NE(find(made, 1), nullptr);
    made.step(visit.at(start + milliseconds(3000)));
    made.step(visit.at(start + milliseconds(3150))); // handed back, and on its way
    EXPECT_EQ(made.prop_share(), 0.0);
    EXPECT_EQ(seen(made, 1, start + milliseconds(3150)).opacity, 1.0);
    made.step(visit.at(start + milliseconds(4300)));
    const Object& chest = made.objects()[1];
    EXPECT_LT(glm::distance(seen(made, 1, start + milliseconds(4300)).table_from_object.translation,
                            table_from_object(chest, 4.3).translation),
              0.01);
    made.step(visit.at(start + milliseconds(7000)));
    EXPECT_TRUE(made.poses().empty()); // its place and turn are the room's own
    EXPECT_FALSE(made.moves());
}

/// A jump of place or speed would show as a difference that does not shrink with the step.
TEST(Taking, MovesWithoutJumpsThroughRandomInterruptions) {
    std::mt19937_64 random(47);
    for (int run_number = 0; run_number < 12; ++run_number) {
        const Visit visit = some_visit(random, 12, milliseconds(6000));
        Taking made = taking();
        const double dt = 2e-4;
        std::vector<std::vector<TakenPose>> last;
        for (int k = 0; k * dt < 8.0; ++k) {
            const MonotonicTime now = start + microseconds(200 * k);
            made.step(visit.at(now));
            last.push_back(all_seen(made, now));
            if (last.size() < 3) {
                continue;
            }
            for (std::size_t object = 0; object < 4; ++object) {
                const TakenPose &a = last[0][object], &b = last[1][object], &c = last[2][object];
                const glm::dvec3 bend = c.table_from_object.translation -
                                        2.0 * b.table_from_object.translation +
                                        a.table_from_object.translation;
                ASSERT_LT(glm::length(bend) / (dt * dt), 250.0) << k << " " << object; // m/s2
                ASSERT_LT(std::abs(c.size_m - 2.0 * b.size_m + a.size_m) / (dt * dt), 60.0);
                const double turn =
                    geometry::rotation_angle(b.table_from_object.rotation, c.table_from_object.rotation);
                ASSERT_LT(turn / dt, 20.0) << k << " " << object; // rad/s
                ASSERT_LT(std::abs(c.opacity - b.opacity) / dt, 40.0);
            }
            last.erase(last.begin());
        }
    }
}

TEST(Taking, IsIndependentOfFrameTimes) {
    std::mt19937_64 random(5);
    for (int number = 0; number < 60; ++number) {
        const Visit visit = some_visit(random, 9, milliseconds(5000));
        const MonotonicTime until = start + microseconds(random() % 7'000'000);
        Taking slow = taking(), steady = taking(), wild = taking();
        run(slow, visit, until, [] { return std::chrono::seconds(1); });
        run(steady, visit, until, [] { return microseconds(8333); });
        run(wild, visit, until, [&] {
            return microseconds(1 + static_cast<std::int64_t>(std::exp(
                                        std::log(1e6) * static_cast<double>(random() % 1000) / 1000.0)));
        });
        for (const Taking* other : {&steady, &wild}) {
            EXPECT_NEAR(slow.prop_share(), other->prop_share(), 1e-9);
            for (std::size_t object = 0; object < 4; ++object) {
                const TakenPose a = seen(slow, object, until), b = seen(*other, object, until);
                EXPECT_LT(glm::distance(a.table_from_object.translation, b.table_from_object.translation),
                          1e-9);
                EXPECT_LT(1.0 -
                              std::abs(glm::dot(a.table_from_object.rotation, b.table_from_object.rotation)),
                          1e-9);
                EXPECT_NEAR(a.size_m, b.size_m, 1e-9);
                EXPECT_NEAR(a.opacity, b.opacity, 1e-9);
            }
        }
    }
}

/// On the screen and in the prop, an artifact's shares of light add up to one: it is never gone, and never there twice.
TEST(Taking, KeepsTheSharesOnScreenAndPropAddingUpToOne) {
    std::mt19937_64 random(11);
    bool some_in_prop = false, some_between = false;
    for (int number = 0; number < 200; ++number) {
        const Visit visit = some_visit(random, 14, milliseconds(7000));
        Taking made = taking();
        for (MonotonicTime now = start; now < start + milliseconds(9000);
             now += microseconds(1 + random() % 60'000)) {
            const TakingInput input = visit.at(now);
            made.step(input);
            const double in_prop = made.prop_share() * input.shown_light;
            some_in_prop = some_in_prop || in_prop > 0.99;
            some_between = some_between || (in_prop > 0.3 && in_prop < 0.7);
            for (std::size_t artifact = 0; artifact < 2; ++artifact) {
                const double on_screen = seen(made, artifact, now).opacity;
                ASSERT_NEAR(on_screen + (input.shown == artifact ? in_prop : 0.0), 1.0, 1e-12);
            }
            const double horses = seen(made, 2, now).opacity + seen(made, 3, now).opacity;
            ASSERT_NEAR(horses + (input.shown == 2 ? in_prop : 0.0), 2.0, 1e-12); // one of them stays
        }
    }
    EXPECT_TRUE(some_in_prop && some_between);
}

TEST(Taking, TakesTheNearerOfTwoInstances) {
    Taking made = taking();
    const Visit visit{{{start, 2}}};
    made.step(visit.at(start));
    made.step(visit.at(start + milliseconds(400)));
    EXPECT_NE(find(made, 3), nullptr); // at 1.2 m
    EXPECT_EQ(find(made, 2), nullptr); // at 2.4 m
}

TEST(Taking, TakesTheInstanceThatThePropRestsBefore) {
    Taking made = taking();
    TakingInput input = Visit{{{start, 2}}}.at(start);
    input.before = 2;
    made.step(input);
    input.now += milliseconds(400);
    input.before.reset();
    made.step(input);
    EXPECT_GT(glm::distance(seen(made, 2, input.now).table_from_object.translation, objects()[2].place_m),
              0.3);
    input.now += milliseconds(2000);
    made.step(input);
    EXPECT_EQ(find(made, 3), nullptr);
}

TEST(Taking, TurnsAroundAnObjectThatIsTakenAgainWhileReturning) {
    Taking made = taking();
    const Visit visit{{{start, 2}, {start + milliseconds(2000), 0}, {start + milliseconds(2600), 2}}};
    MonotonicTime now = start;
    for (; now < start + milliseconds(2600); now += milliseconds(10)) {
        made.step(visit.at(now));
    }
    const glm::dvec3 there = seen(made, 3, now).table_from_object.translation;
    for (; now < start + milliseconds(6000); now += milliseconds(10)) {
        made.step(visit.at(now));
    }
    EXPECT_GT(glm::distance(there, prop_at(now).translation), 0.2); // it was well on its way
    EXPECT_NEAR(glm::distance(seen(made, 3, now - milliseconds(10)).table_from_object.translation,
                              prop_at(now - milliseconds(10)).translation),
                0.0, 1e-12);
    EXPECT_EQ(find(made, 2), nullptr);
    EXPECT_EQ(find(made, 0), nullptr);
}

/// The pose that the artifact is drawn for goes to the idle place at once, in the dark; an object on its way does not.
TEST(Taking, MovesSmoothlyWhenThePropPoseIsLost) {
    Taking made = taking();
    const Visit visit{{{start, 0}}};
    glm::dvec3 before(0.0);
    for (int k = 0; k < 300; ++k) {
        TakingInput input = visit.at(start + milliseconds(10 * k));
        input.table_from_prop = {{1.0, 0.0, 0.0, 0.0}, {0.2, -0.1, 0.1}};
        if (k >= 50) {
            input.idle = true;
            input.table_from_prop = {glm::angleAxis(3.0, glm::dvec3(0.0, 0.0, 1.0)), {-0.2, 0.1, 0.0}};
        }
        input.shown_light = 0.0; // and its artifact is not ready
        made.step(input);
        const glm::dvec3 now = seen(made, 0, input.now).table_from_object.translation;
        if (k > 0) {
            EXPECT_LT(glm::distance(now, before), 0.07) << k;
        }
        before = now;
    }
    EXPECT_NEAR(glm::distance(before, {-0.2, 0.1, 0.0}), 0.0, 1e-9);
}

TEST(Taking, RaisesTheObjectThatThePropRestsBefore) {
    Taking made = taking();
    TakingInput input = Visit{}.at(start);
    input.before = 0;
    made.step(input);
    EXPECT_TRUE(made.poses().empty() || seen(made, 0, start).size_m == 0.5);
    input.now += milliseconds(1200);
    made.step(input);
    EXPECT_GT(seen(made, 0, input.now).table_from_object.translation.z, -0.2 + 0.9 * 0.08 * 0.5);
    EXPECT_GT(seen(made, 0, input.now).size_m, 0.5 * 1.05);
    EXPECT_EQ(seen(made, 0, input.now).opacity, 1.0);
    input.before.reset();
    made.step(input);
    input.now += milliseconds(4000);
    made.step(input);
    EXPECT_TRUE(made.poses().empty());
}

TEST(Taking, ShowsArtifactsWithoutAnObjectOnlyInTheProp) {
    Taking made = taking();
    TakingInput input = Visit{{{start, 2}}}.at(start);
    input.shown = 7;
    made.step(input);
    EXPECT_EQ(made.prop_share(), 1.0);
    made.set_takeable({});
    input.shown = 0;
    made.step(input);
    EXPECT_EQ(made.prop_share(), 1.0);
}

TEST(Taking, KeepsTheTakenObjectWhenArtifactsAreRenumbered) {
    Taking made = taking();
    const Visit visit{{{start, 1}}};
    made.step(visit.at(start));
    const MonotonicTime now = start + milliseconds(3900);
    made.step(visit.at(now));
    const TakenPose before = seen(made, 1, now);
    made.set_takeable(std::array<TakeableObject, 2>{{{0, 4, prop_size_m}, {1, 5, prop_size_m}}});
    TakingInput input = visit.at(now);
    input.chosen = input.shown = 5;
    made.step(input);
    EXPECT_EQ(made.prop_share(), 1.0);
    EXPECT_EQ(seen(made, 1, now).table_from_object.translation, before.table_from_object.translation);
    made.set_takeable({}); // it returns by itself
    input.chosen.reset();
    input.shown_light = 0.0;
    made.step(input);
    EXPECT_EQ(seen(made, 1, now).opacity, 1.0);
    input.now += milliseconds(4000);
    made.step(input);
    EXPECT_TRUE(made.poses().empty());
}

} // namespace
} // namespace frustumscreen::room
