// What a show is told of its frames' times reaches the governor of the artifact that is shown.

#include "tests/show/comings.h"

#include <limits>

namespace frustumscreen::synthetic {
namespace {

TEST_F(Comings, TheTimesOfFramesReachTheGovernor) {
    start(1, true);
    Presentation presentation = step();
    rest();
    ASSERT_EQ(show->state(presentation).levels.ignored_times, 0U);
    constexpr std::uint64_t frames = 10;
    for (std::uint64_t k = 0; k < frames; ++k) {
        presentation = step();
        show->record_time(now,
                          std::numeric_limits<double>::quiet_NaN()); // the governor counts what is no time
    }
    EXPECT_EQ(show->state(presentation).levels.ignored_times, frames);
}

} // namespace
} // namespace frustumscreen::synthetic
