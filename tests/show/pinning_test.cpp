// Frames in which a window is pinned, as the run loop draws them: they allocate nothing.

#include "tests/render/counted_new.h"
#include "tests/show/comings.h"

namespace frustumscreen::synthetic {
namespace {

class Pinning : public Comings {
protected:
    /// Steps once with this press; returns the allocations of the drawing.
    long drawn_with(std::span<const settings::Command> commands) {
        now += std::chrono::milliseconds(20);
        tracking::TrackedState tracked_state;
        tracked_state.prop_known = true;
        tracked_state.eye_m = settings.eye.default_m;
        exhibit->note(show->artifacts());
        const exhibit::Presentation presentation = exhibit->step(now, commands, tracked_state);
        windows = presentation.windows.windows().size();
        const long before = allocations_so_far();
        static_cast<void>(show->draw(now, presentation, std::span(&tracked_state.eye_m, 1),
                                     {display->framebuffer(), 0}, render::Redraw::Everything));
        return allocations_so_far() - before;
    }
    std::size_t windows = 0;
};

TEST_F(Pinning, AFrameThatPinsAllocatesNothing) {
    if (!allocations_are_counted) {
        GTEST_SKIP() << "allocations are not counted under a sanitizer";
    }
    settings.windows.count = 4;
    start(1, false);
    rest();
    const std::array<settings::Command, 1> press{settings::Command::Window};
    drawn_with(press); // with the first window, the driver compiles what draws pictures on the table
    for (int frame = 0; frame < 100; ++frame) {
        drawn_with({});
    }
    for (std::size_t pinned = 2; pinned <= 4; ++pinned) {
        long allocations = drawn_with(press);
        for (int frame = 0; frame < 100; ++frame) {
            allocations += drawn_with({});
        }
        EXPECT_EQ(windows, pinned);
        EXPECT_EQ(allocations, 0) << pinned;
    }
}

} // namespace
} // namespace frustumscreen::synthetic
