// The cache policy, compared with a search through all sets of artifacts.

#include "app/residency/residency.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace frustumscreen::show {
namespace {

struct Scene {
    std::vector<residency::ResidentItem> artifacts;
    std::size_t shown = 0;
    std::vector<std::size_t> wanted;
    std::uint64_t budget = 0;

    /// The artifacts that may exceed the budget: the shown one, and the one that is waited for.
    [[nodiscard]] std::vector<std::size_t> needed() const {
        return wanted.empty() ? std::vector{shown} : std::vector{shown, wanted.front()};
    }
    [[nodiscard]] residency::ResidencyStep step() const {
        return residency::next_step(artifacts, needed(), wanted, budget);
    }
    [[nodiscard]] std::uint64_t bytes() const {
        std::uint64_t bytes = 0;
        for (const residency::ResidentItem& artifact : artifacts) {
            bytes += artifact.loaded ? artifact.bytes : 0;
        }
        return bytes;
    }
};

bool may_exceed(const Scene& scene, std::size_t artifact) {
    return artifact == scene.shown || (!scene.wanted.empty() && artifact == scene.wanted.front());
}

/// The best set within the budget: one urgent artifact outweighs all less urgent ones.
unsigned best_set(const Scene& scene) {
    std::vector<std::size_t> order{scene.shown};
    order.insert(order.end(), scene.wanted.begin(), scene.wanted.end());
    const auto value = [&](unsigned set) { // higher digits for more urgent ones
        std::uint64_t digits = 0;
        for (const std::size_t artifact : order) {
            digits = 2 * digits + ((set >> artifact) & 1U);
        }
        return digits;
    };
    unsigned best = 0;
    for (unsigned set = 0; set < (1U << scene.artifacts.size()); ++set) {
        std::uint64_t bytes = 0;
        bool allowed = true;
        bool others = false;
        for (std::size_t k = 0; k < scene.artifacts.size(); ++k) {
            if (((set >> k) & 1U) != 0) {
                bytes += scene.artifacts[k].bytes;
                allowed = allowed && !scene.artifacts[k].left_out &&
                          std::find(order.begin(), order.end(), k) != order.end();
                others = others || !may_exceed(scene, k);
            }
        }
        if (allowed && (bytes <= scene.budget || !others) && value(set) > value(best)) {
            best = set;
        }
    }
    return best;
}

void settle(Scene& scene) {
    for (int steps = 0;; ++steps) {
        ASSERT_LT(steps, 100) << "it never comes to rest";
        const residency::ResidencyStep step = scene.step();
        ASSERT_FALSE(step.release && step.load);
        if (step.release) {
            residency::ResidentItem& released = scene.artifacts[*step.release];
            ASSERT_TRUE(released.loaded);
            ASSERT_NE(*step.release, scene.shown);
            for (std::size_t k = 0; k < scene.artifacts.size();
                 ++k) { // everything else that could be released was shown later
                const bool stays = ((best_set(scene) >> k) & 1U) != 0 || k == scene.shown;
                if (scene.artifacts[k].loaded && !stays) {
                    ASSERT_GE(scene.artifacts[k].last_shown, released.last_shown);
                }
            }
            released.loaded = false;
        } else if (step.load) {
            residency::ResidentItem& loaded = scene.artifacts[*step.load];
            ASSERT_FALSE(loaded.loaded || loaded.left_out);
            loaded.loaded = true;
            bool alone = true;
            for (std::size_t k = 0; k < scene.artifacts.size(); ++k) {
                alone = alone && (!scene.artifacts[k].loaded || may_exceed(scene, k));
            }
            ASSERT_TRUE(scene.bytes() <= scene.budget || alone);
        } else {
            return;
        }
    }
}

TEST(Residency, LoadsTheBestSetThatTheBudgetAllows) {
    std::mt19937 random(7);
    for (int round = 0; round < 20000; ++round) {
        Scene scene;
        const std::size_t count = 1 + random() % 6;
        for (std::size_t k = 0; k < count; ++k) {
            scene.artifacts.push_back({1 + random() % 9, random() % 2 == 0, random() % 6 == 0, random() % 4});
            scene.artifacts[k].loaded = scene.artifacts[k].loaded && !scene.artifacts[k].left_out;
        }
        scene.shown = random() % count;
        for (std::size_t k = random() % 5; k > 0; --k) {
            scene.wanted.push_back(random() % count);
        }
        scene.budget = 1 + random() % 24;
        settle(scene);
        const unsigned best = best_set(scene);
        for (std::size_t k = 0; k < count; ++k) {
            if (((best >> k) & 1U) != 0) {
                ASSERT_TRUE(scene.artifacts[k].loaded) << round;
            }
        }
    }
}

TEST(Residency, UnloadsTheLeastRecentlyShownOnlyWhenOverBudget) {
    Scene scene{{{4, true, false, 3}, {4, true, false, 1}, {4, true, false, 2}}, 0, {0}, 12};
    EXPECT_EQ(scene.step(), residency::ResidencyStep{});
    scene.budget = 11;
    EXPECT_EQ(scene.step(), (residency::ResidencyStep{1, std::nullopt})); // least recently shown
}

TEST(Residency, DoesNotLoadArtifactsThatAreLeftOut) {
    const Scene scene{{{4, true, false, 3}, {4, false, true, 0}}, 0, {1, 1}, 12};
    EXPECT_EQ(scene.step(), residency::ResidencyStep{});
}

} // namespace
} // namespace frustumscreen::show
