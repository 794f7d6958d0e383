// Stereo is paid for only where it is switched on: with one eye the exhibit draws one picture, and holds the plans of one.
// Its devices are in tests/display (threads, HDMI's 3D modes) and tests/programs (the size of the picture).

#include "app/scene/frame_plan.h"
#include "app/scene/stereo.h"
#include "tests/render/counted_new.h"
#include "tests/show/comings.h"

#include <malloc.h>

namespace frustumscreen::synthetic {
namespace {

/// Bytes that the program has from the allocator.
std::int64_t allocated_bytes() {
    const struct mallinfo2 info = ::mallinfo2();
    return static_cast<std::int64_t>(info.uordblks + info.hblkhd);
}

class OneEye : public ArtifactShowTest {
protected:
    struct Held {
        int draw_calls = 0;     ///< of a whole frame
        std::int64_t bytes = 0; ///< of the show
        std::uint64_t gpu_bytes = 0;
    };
    /// The cost of a layout whose eyes are both in one place.
    Held held(settings::Stereo stereo) {
        show.reset();
        settings.eye.stereo = stereo;
        const scene::StereoLayout layout = scene::stereo_layout(settings);
        display = display::SurfacelessDisplay::create(layout.display.width, layout.display.height).value();
        const std::int64_t before = allocated_bytes();
        start(1, true);
        const std::int64_t bytes = allocated_bytes() - before;
        tracking::TrackedState standing;
        standing.prop_known = true;
        standing.eye_m = settings.eye.default_m;
        const std::vector eyes_m(layout.count, standing.eye_m);
        exhibit::Presentation presentation = exhibit->step(now, {}, standing);
        presentation.brightness = 1.0; // the exhibit begins in the dark
        const render::DrawResult drawn =
            show->draw(now, presentation, eyes_m, {display->framebuffer(), 0}, render::Redraw::Everything);
        return {.draw_calls = drawn.draw_calls, .bytes = bytes, .gpu_bytes = show->use().gpu_bytes};
    }
};

TEST_F(OneEye, IsDrawnOnceAndHasOnePlan) {
    const std::int64_t before = allocated_bytes();
    const scene::FramePlan plan = scene::make_plan(settings::make_prop(settings.prop), 0, 1);
    const std::int64_t plan_bytes = allocated_bytes() - before;
    static_cast<void>(held(settings::Stereo::Off)); // the first show also pays the driver's one-time costs
    const Held one = held(settings::Stereo::Off);
    const Held both = held(settings::Stereo::Anaglyph); // in a picture of the same size
    EXPECT_GT(one.draw_calls, 0);
    EXPECT_EQ(both.draw_calls, 2 * one.draw_calls);
    EXPECT_EQ(both.gpu_bytes, one.gpu_bytes);
    std::printf("a show has %ld bytes, with two eyes' pictures %ld more; an empty plan has %ld\n",
                static_cast<long>(one.bytes), static_cast<long>(both.bytes - one.bytes),
                static_cast<long>(plan_bytes));
    if (allocations_are_counted) {
        EXPECT_GT(plan_bytes, 0);
        EXPECT_LT(one.bytes + plan_bytes, both.bytes) << "the second plan";
    }
    EXPECT_EQ(held(settings::Stereo::FrameSequential).draw_calls, 2 * one.draw_calls);
}

} // namespace
} // namespace frustumscreen::synthetic
