// Frame times reported to a show reach the governor of the shown artifact.

#include "tests/show/comings.h"

#include <limits>

namespace frustumscreen::synthetic {
namespace {

/// A frame may take 0.1 s; a machine that runs tests is faster, so the finer level comes first, and the reported
/// times decide.
TEST_F(ArtifactShowTest, SwitchesToTheCoarserLevelWhenFramesTakeTooLong) {
    settings.projector.refresh_hz = 10.0;
    settings.render.error_tolerance_px = 0.12; // of 2.2 mm: the finer level is within it, the coarser is not
    start(1, true);
    residency::LevelState levels;
    const auto tell = [&](double ms) {
        const exhibit::Presentation presentation = step();
        show->record_time(now, ms);
        levels = show->state(presentation).levels;
    };
    for (int frame = 0; frame < 30; ++frame) {
        tell(60.0);
    }
    EXPECT_EQ(levels.level, "level1");
    for (int frame = 0; frame < 500 && levels.level == "level1"; ++frame) {
        tell(200.0);
    }
    EXPECT_EQ(levels.level, "level0");
    EXPECT_EQ(levels.switches, 1U);
    EXPECT_EQ(levels.ignored_times, 0U);
}

TEST_F(ArtifactShowTest, CountsFrameTimesThatAreNotNumbers) {
    start(1, true);
    exhibit::Presentation presentation = step();
    rest();
    ASSERT_EQ(show->state(presentation).levels.ignored_times, 0U);
    constexpr std::uint64_t frames = 10;
    for (std::uint64_t k = 0; k < frames; ++k) {
        presentation = step();
        show->record_time(now, std::numeric_limits<double>::quiet_NaN());
    }
    EXPECT_EQ(show->state(presentation).levels.ignored_times, frames);
}

} // namespace
} // namespace frustumscreen::synthetic
