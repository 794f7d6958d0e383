// The time that is left, under a simulated clock whose stages take other times than expected.

#include "app/programs/common/time_left.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace frustumscreen::programs {
namespace {

/// Shares of a bake's stages, the first of which reads; `reports`: how often each says how far it is.
struct Work {
    explicit Work(double reading) : shares{reading} {
        for (const double share : {0.07, 0.12, 0.12, 0.13, 0.11, 0.37, 0.08}) {
            shares.push_back((1.0 - reading) * share);
        }
    }
    std::vector<double> shares;
    std::vector<int> reports{100, 1, 1, 6, 1, 1, 7, 1};
};

constexpr double expected_s = 60.0;

struct Outcome {
    double estimated_s = 0.0, true_s = 0.0;
    std::size_t stage = 0;     ///< the one that runs
    bool has_reported = false; ///< it has said that some of it is done
};

/// Works until `at` of the true time, with stages that take `factors` times what was expected.
Outcome estimate(const Work& work, const std::vector<double>& factors, double at) {
    std::vector<double> ends(work.shares.size());
    std::partial_sum(work.shares.begin(), work.shares.end(), ends.begin());
    const double all_s =
        expected_s * std::inner_product(work.shares.begin(), work.shares.end(), factors.begin(), 0.0);
    const double now_s = at * all_s;
    TimeLeft left(ends, expected_s);
    Outcome outcome{.true_s = all_s - now_s};
    double begin_s = 0.0;
    for (std::size_t k = 0; k < factors.size(); ++k) {
        const double stage_s = expected_s * work.shares[k] * factors[k];
        for (int report = 0; report < work.reports[k]; ++report) {
            const double share = static_cast<double>(report) / work.reports[k];
            if (begin_s + share * stage_s <= now_s) {
                left.report(begin_s + share * stage_s, ends[k] - work.shares[k] * (1.0 - share));
                outcome.stage = k;
                outcome.has_reported = report > 0;
            }
        }
        begin_s += stage_s;
    }
    outcome.estimated_s = left.seconds(now_s);
    return outcome;
}

void expect_within_a_factor_of_two(const Outcome& outcome, const std::string& what) {
    EXPECT_LT(outcome.estimated_s, 2.0 * outcome.true_s) << what;
    EXPECT_GT(outcome.estimated_s, 0.5 * outcome.true_s) << what;
}

constexpr std::size_t reading_stages = 1;
constexpr std::size_t all_stages = 8;

std::vector<double> factors_of(double reading, double bake) {
    std::vector<double> factors(all_stages, bake);
    std::fill_n(factors.begin(), reading_stages, reading);
    return factors;
}

TEST(TimeLeft, IsExactWhenStagesTakeTheirExpectedTime) {
    for (const double at : {0.0, 0.2, 0.5, 0.9}) {
        const Outcome outcome = estimate(Work(0.3), factors_of(1.0, 1.0), at);
        EXPECT_NEAR(outcome.estimated_s, outcome.true_s, 1e-9) << at;
    }
}

TEST(TimeLeft, IsWithinAFactorOfTwoAtHalfOfTheTime) {
    int unforeseen = 0;
    for (const double reading : {0.02, 0.1, 0.3, 0.6}) {
        const Work work(reading);
        const std::string share = "reading is " + std::to_string(reading) + " of the work, ";
        for (const double factor : {3.0, 1.0 / 3.0}) {
            const std::string times = " takes " + std::to_string(factor) + " times as long";
            expect_within_a_factor_of_two(estimate(work, factors_of(factor, factor), 0.5),
                                          share + "all" + times);
            expect_within_a_factor_of_two(estimate(work, factors_of(factor, 1.0), 0.5),
                                          share + "reading" + times);
            for (std::size_t k = 0; k < all_stages; ++k) {
                std::vector<double> factors(all_stages, 1.0);
                factors[k] = factor;
                const Outcome outcome = estimate(work, factors, 0.5);
                if (outcome.stage == k && !outcome.has_reported && k + 2 == all_stages) {
                    ++unforeseen; // the longest stage has begun, and nothing says yet that it is another
                    continue;
                }
                expect_within_a_factor_of_two(outcome, share + "stage " + std::to_string(k) + times);
            }
        }
        expect_within_a_factor_of_two(estimate(work, factors_of(1.0, 3.0), 0.5),
                                      share + "baking takes 3 times");
    }
    EXPECT_LE(unforeseen, 2);
}

TEST(TimeLeft, SkippedStageDoesNotChangeTheEstimate) {
    TimeLeft left({0.25, 0.75, 1.0}, 40.0);
    left.report(0.0, 0.0);
    left.report(10.0, 0.75); // without the second one
    EXPECT_NEAR(left.seconds(10.0), 10.0, 1e-9);
}

TEST(TimeLeft, SlowReadingDoesNotSlowTheExpectedBakeAsMuch) {
    const Work work(0.3);
    const std::vector<double> factors = factors_of(10.0, 1.0); // a slow disk
    const double reading_s = expected_s * 0.3 * 10.0;
    const double bake_s = expected_s * 0.7;
    const Outcome outcome = estimate(work, factors, reading_s / (reading_s + bake_s) + 1e-6);
    EXPECT_EQ(outcome.stage, reading_stages);
    EXPECT_LT(outcome.estimated_s, 3.3 * bake_s) << "by the root of 10";
    const Outcome later = estimate(work, factors, 0.95);
    expect_within_a_factor_of_two(later, "near the end");
}

} // namespace
} // namespace frustumscreen::programs
