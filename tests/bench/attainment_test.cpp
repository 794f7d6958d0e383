// Fronts and the median front of several artifacts, against what a person works out.

#include "app/bench/attainment.h"
#include "app/bench/time_left.h"

#include <gtest/gtest.h>

namespace frustumscreen {
namespace {

using Points = std::vector<glm::dvec2>;

TEST(ParetoFront, KeepsWhatNothingIsLeftOfAndBelow) {
    EXPECT_EQ(pareto_front(Points{{3, 1}, {1, 3}, {2, 4}, {2, 2}, {3, 1}, {4, 1}, {1, 5}}),
              (Points{{1, 3}, {2, 2}, {3, 1}}));
    EXPECT_TRUE(pareto_front({}).empty());
}

TEST(MedianAttainment, IsWhatHalfOfTheArtifactsReach) {
    const std::vector<Points> three = {{{1, 10}, {4, 2}}, {{2, 8}, {5, 1}}, {{3, 20}}};
    // At 1 one of three reaches anything; at 2 two do: 8 and 10; at 4: 2, 8 and 20; at 5: 1, 2 and 20.
    EXPECT_EQ(median_attainment(three), (Points{{2, 10}, {4, 8}, {5, 2}}));
    EXPECT_EQ(median_attainment(std::vector<Points>{three[0]}), three[0]);
    EXPECT_TRUE(median_attainment({}).empty());
    EXPECT_TRUE(median_attainment(std::vector<Points>{{}, {}, {{1, 1}}}).empty());
}

TEST(MedianAttainment, OfEqualArtifactsIsTheirFront) {
    const Points points = {{1, 5}, {2, 6}, {3, 2}, {9, 1}};
    EXPECT_EQ(median_attainment(std::vector<Points>(4, points)), pareto_front(points));
}

TEST(TimeLeft, CountsTheStepsToCome) {
    TimeLeft left({{"near: errors", "errors", 10.0},
                   {"near: times", "times", 20.0},
                   {"kiosk: errors", "errors", 10.0},
                   {"kiosk: times", "times", 20.0}});
    EXPECT_FALSE(left.at("near: errors", 0.0, 100.0)); // nothing is known
    // A quarter in 5 s: 15 s of it left, and 5 guesses as long again as it, 2 s each.
    EXPECT_DOUBLE_EQ(*left.at("near: errors", 0.25, 105.0), 15.0 + 40.0 + 20.0 + 40.0);
    (void)left.at("near: errors", 1.0, 120.0);
    EXPECT_DOUBLE_EQ(*left.at("near: times", 0.5, 220.0 - 100.0), 0.0 + 20.0 + 0.0);
}

TEST(TimeLeft, AStepTakesAsLongAsTheLastOfItsKind) {
    TimeLeft left({{"near: errors", "errors", 10.0},
                   {"near: times", "times", 1.0},
                   {"kiosk: errors", "errors", 20.0},
                   {"kiosk: times", "times", 1.0}});
    (void)left.at("near: errors", 0.0, 0.0);
    (void)left.at("near: errors", 1.0, 10.0);
    (void)left.at("near: times", 0.0, 10.0);
    EXPECT_DOUBLE_EQ(*left.at("near: times", 0.5, 60.0), 50.0 + 20.0 + 100.0);
    (void)left.at("near: times", 1.0, 110.0);
    EXPECT_DOUBLE_EQ(*left.at("kiosk: errors", 0.0, 110.0), 20.0 + 100.0);
    EXPECT_DOUBLE_EQ(*left.at("kiosk: errors", 0.5, 130.0), 20.0 + 100.0); // slower than it was thought
}

TEST(TimeLeft, WithoutAPlanItIsThatOfTheStepAlone) {
    TimeLeft left;
    EXPECT_FALSE(left.at("a", 0.0, 0.0));
    EXPECT_DOUBLE_EQ(*left.at("a", 0.5, 3.0), 3.0);
    EXPECT_EQ(words_of_time(3.2), "3 s");
    EXPECT_EQ(words_of_time(239.0), "4 min");
    EXPECT_EQ(words_of_time(7500.0), "2 h 5 min");
}

} // namespace
} // namespace frustumscreen
