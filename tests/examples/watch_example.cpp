// The ladder takes the mildest action that may remedy a fault, waits for its effect, and takes the next
// one.
#include "app/watch/ladder.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Watch) {
    // example
    using std::chrono::seconds;
    watch::Ladder ladder(watch::LadderMemory{}, true);
    const watch::Observation dark{watch::Cause::NoPicture, false};
    const watch::Capabilities all{.last_good_set = true, .device = true, .reboot = true};
    EXPECT_EQ(ladder.look(seconds(1), dark, all)->step, watch::Step::RestartExhibit);
    EXPECT_FALSE(ladder.look(seconds(5), dark, all)); // a restart shows its effect after ten seconds
    EXPECT_EQ(ladder.look(seconds(25), dark, all)->step, watch::Step::LastGoodSet);
    // end
}

} // namespace
} // namespace frustumscreen::example
