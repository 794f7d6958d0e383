// The remaining time of a run, with made-up times.

#include "app/bench/measures/time_left.h"
#include "firmware_host/base/words_of_time.h"

#include <gtest/gtest.h>

namespace frustumscreen::bench {
namespace {

TEST(TimeLeft, IncludesTheRemainingSteps) {
    TimeLeft left({{"near: errors", "errors", 10.0},
                   {"near: times", "times", 20.0},
                   {"kiosk: errors", "errors", 10.0},
                   {"kiosk: times", "times", 20.0}});
    EXPECT_FALSE(left.update("near: errors", 0.0, 100.0)); // no duration is known
    // A quarter in 5 s: 15 s of this step are left; the other steps take their guesses times 2.
    EXPECT_DOUBLE_EQ(*left.update("near: errors", 0.25, 105.0), 15.0 + 40.0 + 20.0 + 40.0);
    (void)left.update("near: errors", 1.0, 120.0);
    EXPECT_DOUBLE_EQ(*left.update("near: times", 0.5, 220.0 - 100.0), 0.0 + 20.0 + 0.0);
}

TEST(TimeLeft, AStepTakesAsLongAsTheLastOfItsKind) {
    TimeLeft left({{"near: errors", "errors", 10.0},
                   {"near: times", "times", 1.0},
                   {"kiosk: errors", "errors", 20.0},
                   {"kiosk: times", "times", 1.0}});
    (void)left.update("near: errors", 0.0, 0.0);
    (void)left.update("near: errors", 1.0, 10.0);
    (void)left.update("near: times", 0.0, 10.0);
    EXPECT_DOUBLE_EQ(*left.update("near: times", 0.5, 60.0), 50.0 + 20.0 + 100.0);
    (void)left.update("near: times", 1.0, 110.0);
    EXPECT_DOUBLE_EQ(*left.update("kiosk: errors", 0.0, 110.0), 20.0 + 100.0);
    EXPECT_DOUBLE_EQ(*left.update("kiosk: errors", 0.5, 130.0), 20.0 + 100.0); // slower than predicted
}

TEST(TimeLeft, EstimatesOnlyTheCurrentStepWithoutAPlan) {
    TimeLeft left;
    EXPECT_FALSE(left.update("a", 0.0, 0.0));
    EXPECT_DOUBLE_EQ(*left.update("a", 0.5, 3.0), 3.0);
    EXPECT_FALSE(left.update("b", 0.0, 10.0));
    EXPECT_DOUBLE_EQ(*left.update("b", 0.25, 11.0), 3.0);
    EXPECT_FALSE(left.update("a", 0.0, 20.0)); // the step runs once more
    EXPECT_DOUBLE_EQ(*left.update("a", 0.5, 21.0), 1.0);
    EXPECT_EQ(words_of_time(3.2), "3 s");
    EXPECT_EQ(words_of_time(239.0), "4 min");
    EXPECT_EQ(words_of_time(7500.0), "2 h 5 min");
}

} // namespace
} // namespace frustumscreen::bench
