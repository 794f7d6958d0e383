// A visit of thirty seconds is counted under its hour, and under the artifact that was shown.
#include "app/counts/day_counts.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Counts) {
    // example
    using std::chrono::seconds;
    const MonotonicTime start{}, pressed = start + seconds(5), rests = start + seconds(35);
    counts::VisitCounter counter;
    std::vector<counts::VisitPiece> pieces;
    for (MonotonicTime now = start; now <= rests; now += seconds(1)) { // a step in each frame
        counter.step({now, now < pressed ? std::nullopt : std::optional(pressed),
                      now < pressed || now == rests, false, "A cup", "en"},
                     pieces);
    }
    counts::DayCounts day;
    for (const counts::VisitPiece& piece : pieces) {
        day.add(piece, 10); // between 10 and 11 o'clock
    }
    EXPECT_EQ(day.hours[10], (counts::Tally{1, 30'000}));
    EXPECT_EQ(day.artifacts.at("A cup"), (counts::Tally{1, 30'000}));
    // end
}

} // namespace
} // namespace frustumscreen::example
