// Frames in which a window is pinned, as the run loop draws them: they allocate nothing, and the window keeps a torch's light.

#include "app/pack/pack_torches.h"
#include "tests/render/counted_new.h"
#include "tests/show/comings.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace frustumscreen::synthetic {
namespace {

class Pinning : public ArtifactShowTest {
protected:
    /// Steps once with this press; returns the allocations of the drawing.
    long drawn_with(std::span<const settings::Command> commands) {
        now += std::chrono::milliseconds(20);
        tracking::TrackedState tracked_state;
        tracked_state.prop_known = true;
        tracked_state.eye_m = settings.eye.default_m;
        if (torch_is_on) { // above the prop, straight down
            tracked_state.torches[0] = {.table_from_torch = {{0.0, 1.0, 0.0, 0.0}, {0.02, 0.0, 0.45}},
                                        .share = 1.0,
                                        .presence = tracking::TorchPresence::InHand};
        }
        exhibit->note(show->artifacts());
        const exhibit::Presentation presentation = exhibit->step(now, commands, tracked_state);
        windows = presentation.windows.windows().size();
        const long before = allocations_so_far();
        static_cast<void>(show->draw(now, presentation, std::span(&tracked_state.eye_m, 1),
                                     {display->framebuffer(), 0}, render::Redraw::Everything));
        return allocations_so_far() - before;
    }
    /// The picture after two seconds without a press.
    image::Image8 settled_picture() {
        for (int frame = 0; frame < 100; ++frame) {
            drawn_with({});
        }
        return render::read_colour(display->framebuffer(), 320, 200);
    }
    std::size_t windows = 0;
    bool torch_is_on = false;
};

/// Pictures of an exhibit whose window was pinned with or without a torch.
class PinnedLight : public Pinning {
protected:
    struct Pictures {
        image::Image8 before, lit, after; ///< before the press; after it; when the torch is off again
    };
    Pictures pinned(bool with_torch, bool live) {
        settings.windows = {.count = 1, .width_m = 0.12, .depth_m = 0.12, .live = live};
        settings.torch.source = settings::TorchSource::Tracker;
        torch_is_on = false;
        start(1, true);
        Pictures pictures;
        pictures.before = settled_picture();
        torch_is_on = with_torch;
        static_cast<void>(settled_picture());
        drawn_with(press);
        pictures.lit = settled_picture();
        EXPECT_EQ(windows, 1U);
        torch_is_on = false;
        pictures.after = settled_picture();
        return pictures;
    }
    /// The window's pixels, and the sums of the light that two pictures have there and elsewhere.
    struct Sums {
        long window = 0, in_first = 0, in_second = 0, differ_elsewhere = 0;
    };
    static Sums compare(const Pictures& unlit, const image::Image8& first, const image::Image8& second) {
        Sums sums;
        for (std::size_t k = 0; k < first.texels.size(); ++k) {
            if (unlit.before.texels[k] == unlit.after.texels[k]) {
                sums.differ_elsewhere += first.texels[k] != second.texels[k] ? 1 : 0;
                continue;
            }
            ++sums.window;
            sums.in_first += first.texels[k].r;
            sums.in_second += second.texels[k].r;
        }
        return sums;
    }
    const std::array<settings::Command, 1> press{settings::Command::Window};
};

TEST_F(PinnedLight, StaysInAFrozenWindowAndFollowsTheTorchInALiveOne) {
    const Pictures unlit = pinned(false, false);
    for (const bool live : {false, true}) {
        const Pictures lit = pinned(true, live);
        const Sums during = compare(unlit, unlit.after, lit.lit);
        EXPECT_GT(during.window, 200);
        EXPECT_GT(during.in_second, during.in_first + 5 * during.window)
            << "the window shows the torch's light";
        const Sums after = compare(unlit, unlit.after, lit.after);
        EXPECT_EQ(after.differ_elsewhere, 0) << "the prop is as it was";
        if (live) {
            EXPECT_EQ(lit.after.texels, unlit.after.texels) << "the torch is off";
        } else {
            EXPECT_EQ(after.in_second, during.in_second) << "its light is kept";
        }
    }
}

/// The first pack has a content of a torch: a white picture.
pack::Pack pack_with_picture() {
    pack::Pack pack = numbered_pack(0);
    torch::Stage stage;
    stage.source = torch::Source::Picture;
    pack::PackTorches torches;
    torches.contents = {{{.name = "picture", .blend = torch::Blend::Light, .stages = {stage}}, {}}};
    torches.pictures = {{16, 16, ""}};
    pack::TorchParts parts;
    parts.pictures = {image::encode_webp(image::Image8(16, 16, {255, 255, 255, 255}))};
    const Result<void> put = pack::put_torches(pack, torches, std::move(parts));
    EXPECT_TRUE(put) << put.error().message;
    return pack;
}

TEST_F(PinnedLight, PictureFadesOutOfAFrozenWindowWhenTheArtifactChanges) {
    ASSERT_TRUE(write_file(files.files().front(), pack::write_pack(pack_with_picture()).value()));
    settings.windows = {.count = 1, .width_m = 0.12, .depth_m = 0.12};
    settings.torch.source = settings::TorchSource::Tracker;
    settings.torch.house_light = 1.0;
    start(2, true);
    const image::Image8 bare = settled_picture();
    torch_is_on = true;
    static_cast<void>(settled_picture());
    drawn_with(press);
    static_cast<void>(settled_picture());
    torch_is_on = false;
    const image::Image8 lit = settled_picture();
    const auto light = [&](const image::Image8& picture) {
        long sum = 0;
        for (std::size_t k = 0; k < picture.texels.size(); ++k) {
            sum += bare.texels[k] != lit.texels[k] ? picture.texels[k].r : 0;
        }
        return sum;
    };
    std::vector<long> sums{light(lit)};
    drawn_with(next);
    for (int frame = 0; frame < 100; ++frame) {
        drawn_with({});
        sums.push_back(light(render::read_colour(display->framebuffer(), 320, 200)));
    }
    // Then points draw the window, if they are quicker on this machine; simulated time has no fade between both.
    sums.erase(std::min_element(sums.begin(), sums.end()) + 1, sums.end());
    const long all = sums.front() - sums.back();
    EXPECT_GT(all, sums.front() / 20) << "the picture's light is gone";
    long most = 0;
    int fading = 0;
    for (std::size_t k = 1; k < sums.size(); ++k) {
        most = std::max(most, std::abs(sums[k] - sums[k - 1]));
        fading += sums[k] != sums[k - 1] ? 1 : 0;
    }
    std::printf("%ld of %ld codes go, at most %ld in a frame, in %d frames\n", all, sums.front(), most,
                fading);
    EXPECT_LT(most, all / 6) << "half a second has 25 frames";
    EXPECT_GE(fading, 15);
}

TEST_F(Pinning, PinningAWindowAllocatesNothing) {
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
