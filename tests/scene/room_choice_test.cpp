// How each object of a room is drawn within a frame's time.

#include "app/scene/room_choice.h"
#include "tests/render/counted_new.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace frustumscreen::scene {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// A list of objects with as many options each.
struct Objects {
    std::vector<RoomSeen> seen;
    std::vector<RoomOption> options;

    void add(const std::vector<RoomOption>& own, double pixels = 1.0) {
        seen.push_back({.object = static_cast<std::uint32_t>(seen.size()),
                        .first = static_cast<std::uint32_t>(options.size()),
                        .count = static_cast<std::uint32_t>(own.size()),
                        .pixels = pixels});
        options.insert(options.end(), own.begin(), own.end());
    }
    [[nodiscard]] RoomOption chosen(const RoomChoice& choice, std::size_t object) const {
        return options[seen[object].first + choice.of(seen[object].object)];
    }
};

TEST(RoomChoice, TakesTheQuickestSufficientOption) {
    Objects objects;
    objects.add({{2.0, 1.0}, {0.4, 5.0}, {0.3, 4.0}, {0.1, 20.0}});
    objects.add({{2.0, 1.0}, {0.9, 5.0}}); // none is enough
    objects.add({{0.1, never}, {0.7, 3.0}});
    objects.add({{0.1, never}});
    RoomChoice choice(4);
    choice.choose(0.0, objects.seen, objects.options, 0.5, never);
    EXPECT_EQ(choice.of(0), 2U);
    EXPECT_EQ(choice.of(1), 1U) << "the one that errs least";
    EXPECT_EQ(choice.of(2), 1U) << "the better one is not loaded";
    EXPECT_EQ(choice.of(3), RoomChoice::none);
    EXPECT_DOUBLE_EQ(choice.cost_us(), 4.0 + 5.0 + 3.0);
    EXPECT_FALSE(choice.is_short());
}

/// Convex options, as levels have: the greedy steps then leave at most one step's time unused.
Objects random_objects(unsigned seed, std::size_t count) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> between(0.5, 2.0);
    Objects objects;
    for (std::size_t k = 0; k < count; ++k) {
        const double error = between(random);
        const double cost = between(random);
        objects.add({{8.0 * error, cost},
                     {2.0 * error, 2.0 * cost},
                     {0.5 * error, 4.0 * cost},
                     {0.2 * error, 8.0 * cost}},
                    between(random));
    }
    return objects;
}

TEST(RoomChoice, MatchesExhaustiveSearchWhenShortOfTime) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Objects objects = random_objects(seed, 6);
        RoomChoice choice(6);
        choice.choose(0.0, objects.seen, objects.options, 0.3, 1e9);
        const double all_us = choice.cost_us();
        RoomChoice tight(6);
        const double budget_us = 0.6 * all_us;
        tight.choose(0.0, objects.seen, objects.options, 0.3, budget_us);
        EXPECT_TRUE(tight.is_short());
        EXPECT_LE(tight.cost_us(), budget_us);
        double error = 0.0;
        for (std::size_t k = 0; k < 6; ++k) {
            error += objects.seen[k].pixels * objects.chosen(tight, k).error_px;
        }
        // 0.9 of the budget is for new choices; one step more may be unused.
        double step_us = 0.0;
        for (const RoomOption& option : objects.options) {
            step_us = std::max(step_us, 0.5 * option.cost_us);
        }
        double best = never;
        for (unsigned all = 0; all < 4096; ++all) {
            double cost_us = 0.0;
            double sum = 0.0;
            for (std::size_t k = 0; k < 6; ++k) {
                const RoomOption& option = objects.options[objects.seen[k].first + (all >> (2 * k) & 3U)];
                cost_us += option.cost_us;
                sum += objects.seen[k].pixels * option.error_px;
            }
            best = cost_us <= 0.9 * budget_us - step_us ? std::min(best, sum) : best;
        }
        EXPECT_LE(error, best) << seed;
    }
}

TEST(RoomChoice, DoesNotOscillateForASwayingEye) {
    RoomChoice choice(1);
    int changes = 0;
    std::uint32_t before = RoomChoice::none;
    for (int frame = 0; frame < 200; ++frame) {
        const double away = 1.0 + 0.03 * std::sin(0.7 * frame);
        Objects objects;
        objects.add({{0.5 / away, 10.0}, {0.2 / away, 30.0}});
        choice.choose(frame / 60.0, objects.seen, objects.options, 0.5, 1e9);
        changes += frame > 0 && choice.of(0) != before ? 1 : 0;
        before = choice.of(0);
    }
    EXPECT_LE(changes, 1);
}

TEST(RoomChoice, ChangesLittleForASwayingBudgetAndRecovers) {
    const Objects objects = random_objects(3, 40);
    RoomChoice choice(40);
    choice.choose(0.0, objects.seen, objects.options, 0.3, 1e9);
    const double all_us = choice.cost_us();
    std::vector<std::uint32_t> before(40);
    int changes = 0;
    for (int frame = 0; frame < 600; ++frame) {
        choice.choose(frame / 60.0, objects.seen, objects.options, 0.3,
                      (0.7 + 0.03 * std::sin(0.5 * frame)) * all_us);
        for (std::uint32_t k = 0; k < 40; ++k) {
            changes += frame > 0 && choice.of(k) != before[k] ? 1 : 0;
            before[k] = choice.of(k);
        }
    }
    EXPECT_LE(changes, 20);
    choice.choose(20.0, objects.seen, objects.options, 0.3, 1e9);
    EXPECT_FALSE(choice.is_short());
    EXPECT_DOUBLE_EQ(choice.cost_us(), all_us);
}

TEST(RoomChoice, AllocatesNothing) {
    const Objects objects = random_objects(5, 200);
    RoomChoice choice(200);
    const long before = synthetic::allocations_so_far();
    for (int frame = 0; frame < 20; ++frame) {
        choice.choose(frame, objects.seen, objects.options, 0.3, 100.0 + 30.0 * frame);
    }
    if (synthetic::allocations_are_counted) {
        EXPECT_EQ(synthetic::allocations_so_far(), before);
    }
}

} // namespace
} // namespace frustumscreen::scene
