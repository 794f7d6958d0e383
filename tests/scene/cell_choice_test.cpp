// The choice of each cell's level, against every combination there is.

#include "app/scene/cell_choice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace frustumscreen::scene {
namespace {

using std::chrono::milliseconds;

struct Given {
    std::vector<std::size_t> counts;
    std::vector<CellOption> options;

    [[nodiscard]] const CellOption& option(std::size_t cell, std::size_t k) const {
        std::size_t first = 0;
        for (std::size_t before = 0; before < cell; ++before) {
            first += counts[before];
        }
        return options[first + k];
    }
    [[nodiscard]] CellOption sum(std::span<const std::size_t> choice) const {
        CellOption sum;
        for (std::size_t cell = 0; cell < counts.size(); ++cell) {
            sum.error_mm += option(cell, choice[cell]).error_mm;
            sum.cost_us += option(cell, choice[cell]).cost_us;
        }
        return sum;
    }
};

Given random_cells(std::mt19937& random) {
    Given given;
    given.counts.resize(1 + random() % 5);
    std::uniform_real_distribution<double> error_mm(0.0, 1.0);
    std::uniform_real_distribution<double> cost_us(1.0, 1000.0);
    for (std::size_t& count : given.counts) {
        count = 1 + random() % 4;
        for (std::size_t k = 0; k < count; ++k) {
            given.options.push_back({error_mm(random), cost_us(random)});
        }
    }
    return given;
}

/// Calls `visit` with each combination.
template <typename Visit> void for_each_choice(const Given& given, const Visit& visit) {
    std::vector<std::size_t> choice(given.counts.size());
    while (true) {
        visit(given.sum(choice));
        std::size_t cell = 0;
        while (cell < choice.size() && ++choice[cell] == given.counts[cell]) {
            choice[cell++] = 0;
        }
        if (cell == choice.size()) {
            return;
        }
    }
}

/// The most error that one step along a cell's lower hull saves (Andrew's monotone chain).
double greatest_step_mm(const Given& given) {
    double greatest = 0.0;
    for (std::size_t cell = 0; cell < given.counts.size(); ++cell) {
        std::vector<std::pair<double, double>> points; // cost, error
        for (std::size_t k = 0; k < given.counts[cell]; ++k) {
            points.emplace_back(given.option(cell, k).cost_us, given.option(cell, k).error_mm);
        }
        std::sort(points.begin(), points.end());
        std::vector<std::pair<double, double>> hull;
        for (const auto& c : points) {
            while (hull.size() > 1) {
                const auto& a = hull[hull.size() - 2];
                const auto& b = hull.back();
                if ((b.first - a.first) * (c.second - a.second) >
                    (b.second - a.second) * (c.first - a.first)) {
                    break;
                }
                hull.pop_back();
            }
            hull.push_back(c);
        }
        for (std::size_t k = 1; k < hull.size(); ++k) {
            greatest = std::max(greatest, hull[k - 1].second - hull[k].second);
        }
    }
    return greatest;
}

TEST(CellChoice, IsWithinOneStepOfTheBestOfAllCombinations) {
    std::mt19937 random(46);
    int bounded = 0;
    for (int round = 0; round < 3000; ++round) {
        const Given given = random_cells(random);
        double min_cost_us = std::numeric_limits<double>::infinity();
        double max_cost_us = 0.0;
        for_each_choice(given, [&](const CellOption& sum) {
            min_cost_us = std::min(min_cost_us, sum.cost_us);
            max_cost_us = std::max(max_cost_us, sum.cost_us);
        });
        const double budget_us =
            std::uniform_real_distribution<double>(0.5 * min_cost_us, 1.1 * max_cost_us)(random);
        double min_error_mm = std::numeric_limits<double>::infinity();
        for_each_choice(given, [&](const CellOption& sum) {
            if (sum.cost_us <= budget_us) {
                min_error_mm = std::min(min_error_mm, sum.error_mm);
            }
        });
        CellChoice choice(given.counts);
        const CellOption found = given.sum(choice.choose({}, given.options, budget_us));
        if (min_cost_us > budget_us) {
            EXPECT_NEAR(found.cost_us, min_cost_us, 1e-9) << round;
            continue;
        }
        ++bounded;
        EXPECT_LE(found.cost_us, budget_us) << round;
        EXPECT_LE(found.error_mm, min_error_mm + greatest_step_mm(given) + 1e-9) << round;
    }
    EXPECT_GT(bounded, 2000);
}

TEST(CellChoice, KeepsTheBudgetInEveryFrameAndChangesEachCellRarely) {
    std::mt19937 random(47);
    const Given start = [&] {
        Given given = random_cells(random);
        while (given.counts.size() < 4 || given.options.size() < 12) {
            given = random_cells(random);
        }
        return given;
    }();
    CellChoice choice(start.counts);
    std::vector<std::size_t> before;
    MonotonicTime now;
    std::vector<MonotonicTime> changed(start.counts.size());
    std::uniform_real_distribution<double> noise(0.95, 1.05);
    double min_us = std::numeric_limits<double>::infinity();
    double max_us = 0.0;
    for_each_choice(start, [&](const CellOption& sum) {
        min_us = std::min(min_us, sum.cost_us);
        max_us = std::max(max_us, sum.cost_us);
    });
    const double budget_us = 0.5 * (min_us + max_us);
    for (int frame = 0; frame < 2000; ++frame, now += milliseconds(16)) {
        Given noisy = start;
        for (CellOption& option : noisy.options) {
            option.error_mm *= noise(random);
            option.cost_us *= noise(random);
        }
        const bool was_good = !before.empty() && noisy.sum(before).cost_us <= budget_us;
        const auto chosen = choice.choose(now, noisy.options, budget_us);
        double min_cost_us = std::numeric_limits<double>::infinity();
        for_each_choice(noisy,
                        [&](const CellOption& sum) { min_cost_us = std::min(min_cost_us, sum.cost_us); });
        if (min_cost_us <= budget_us) {
            EXPECT_LE(noisy.sum(chosen).cost_us, budget_us) << frame;
        }
        for (std::size_t cell = 0; cell < changed.size() && !before.empty(); ++cell) {
            if (before[cell] != chosen[cell]) {
                EXPECT_TRUE(!was_good || now - changed[cell] >= cell_dwell) << frame;
                changed[cell] = now;
            }
        }
        before.assign(chosen.begin(), chosen.end());
    }
    EXPECT_LE(choice.switches(), 8U); // noise of 5 % is no reason to change
}

TEST(CellChoice, LowersLevelsAtOnceAndRaisesThemLater) {
    const std::vector<std::size_t> counts{2, 2};
    std::vector<CellOption> options{{1.0, 100.0}, {0.1, 400.0}, {1.0, 100.0}, {0.1, 400.0}};
    CellChoice choice(counts);
    MonotonicTime now{};
    const auto chosen = [&](double budget_us) {
        const auto found = choice.choose(now, options, budget_us);
        return std::vector<std::size_t>(found.begin(), found.end());
    };
    EXPECT_EQ(chosen(1000.0), (std::vector<std::size_t>{1, 1}));
    now += milliseconds(10);
    EXPECT_EQ(chosen(300.0), (std::vector<std::size_t>{0, 0}));
    now += milliseconds(10);
    EXPECT_EQ(chosen(1000.0), (std::vector<std::size_t>{0, 0}));
    now += cell_dwell;
    EXPECT_EQ(chosen(880.0), (std::vector<std::size_t>{1, 0})); // 800 us would leave less than a tenth free
    now += cell_dwell;
    EXPECT_EQ(chosen(900.0), (std::vector<std::size_t>{1, 1}));
    EXPECT_EQ(choice.switches(), 4U);
}

} // namespace
} // namespace frustumscreen::scene
