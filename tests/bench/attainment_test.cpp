// Fronts and the median front of several artifacts, against what a person works out.

#include "app/bench/attainment.h"

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

} // namespace
} // namespace frustumscreen
