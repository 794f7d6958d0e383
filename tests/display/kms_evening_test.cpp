// An exhibit from start to end on the fake kernel, normally and with each call failing once.
#include "tests/display/fake_desk.h"

namespace frustumscreen::display {
namespace {

bool holds(std::string_view text, std::string_view words) {
    return text.find(words) != std::string_view::npos;
}

OutputRequest wish(int width = 0, int height = 0) {
    OutputRequest request;
    request.width = width;
    request.height = height;
    request.picture_width = 320;
    request.picture_height = 200;
    return request;
}

/// Presents pictures on an open card, and checks the connections before each.
class Evening {
public:
    Evening(CardOnDesk& desk, const OutputRequest& request = wish())
        : desk_(desk), card_(KmsCard::open(card_path, request)) {
        if (!card_) {
            end_ = card_.error().message;
        } else if (!take_screen(card_->file())) {
            end_ = "display: another program holds the screen"; // as in KmsDisplay::create
        } else {
            kms_ = make_kms_device(*card_);
            clock_.emplace(*kms_);
            presenter_.emplace(
                *clock_, [this](PixelSize size) { return UndrawnPair::make(card_->file(), size); }, request);
        }
    }

    void frames(int count, bool asleep = false) {
        for (int k = 0; k < count && end_.empty(); ++k) {
            CardSeen seen = card_->look(!presenter_->lit());
            if (seen != seen_) {
                seen_ = seen;
                presenter_->connected(std::move(seen));
            }
            const Result<void> shown = asleep ? presenter_->stay_dark(true)
                                              : presenter_->present({0, 0, 320, 200}, true).map([](auto) {});
            if (!shown) {
                end_ = shown.error().message;
            }
            clock_->time += std::chrono::milliseconds(400);
            desk_.card.refresh();
        }
    }
    /// A cable was moved, and the kernel reports it.
    void plugged() {
        if (end_.empty()) {
            seen_ = card_->look(true);
            presenter_->connected(seen_);
        }
    }
    [[nodiscard]] bool lit() const { return desk_.card.shown(desk_.hdmi) || desk_.card.shown(desk_.other); }
    /// Why it cannot continue; empty: it can.
    [[nodiscard]] const std::string& end() const { return end_; }
    [[nodiscard]] DeviceHealth health() const { return presenter_->condition().health; }
    [[nodiscard]] std::string state() const {
        return presenter_ ? std::string(presenter_->state()) : std::string();
    }
    [[nodiscard]] std::string mode() const {
        const auto shown = desk_.card.shown(desk_.hdmi);
        return shown ? std::to_string(shown->mode.hdisplay) + "x" + std::to_string(shown->mode.vdisplay)
                     : "dark";
    }

private:
    CardOnDesk& desk_;
    Result<KmsCard> card_;
    std::unique_ptr<KmsDevice> kms_;
    std::optional<OnTestClock> clock_;
    std::optional<Presenter> presenter_;
    CardSeen seen_;
    std::string end_;
};

/// `GetParam`: whether the driver has atomic commits.
class KmsSession : public Desk, public testing::WithParamInterface<bool> {
protected:
    KmsSession() {
        desk.card.atomic = GetParam();
        desk.card.flips_at_once = false;
    }
    std::string told_; ///< the last sentence about the output
};
INSTANTIATE_TEST_SUITE_P(Kms, KmsSession, testing::Bool(),
                         [](const auto& tested) { return tested.param ? "Atomic" : "Legacy"; });

TEST_P(KmsSession, HandlesHotplugSleepAndEnd) {
    {
        Evening evening(desk);
        evening.frames(4);
        EXPECT_EQ(evening.mode(), "320x200");
        EXPECT_EQ(evening.state(), "the projector at HDMI-A-1 is lit, 320 x 200 at 60 Hz");
        EXPECT_EQ(evening.health(), DeviceHealth::Well);
        desk.card.unplug(desk.hdmi);
        evening.plugged();
        evening.frames(2);
        EXPECT_EQ(evening.mode(), "dark");
        EXPECT_TRUE(holds(evening.state(), "no projector is connected")) << evening.state();
        EXPECT_EQ(evening.health(), DeviceHealth::Away);
        desk.card.plug(desk.hdmi, {kernel_mode(256, 192, 60.0, true)});
        evening.plugged();
        evening.frames(3);
        EXPECT_EQ(evening.mode(), "256x192") << "another projector";
        evening.frames(3, true);
        EXPECT_EQ(evening.mode(), "dark");
        EXPECT_TRUE(holds(evening.state(), "dark on purpose")) << evening.state();
        EXPECT_EQ(evening.health(), DeviceHealth::Well);
        evening.frames(3);
        EXPECT_EQ(evening.mode(), "256x192");
        EXPECT_EQ(desk.card.removed_while_shown(), 0);
        EXPECT_EQ(evening.end(), "");
    }
    EXPECT_FALSE(desk.card.shown(desk.hdmi));
    const auto& calls = kernel.calls();
    EXPECT_EQ(std::count(calls.begin(), calls.end(), "drmModeCreateLease"), 0) << "there is no screen";
    EXPECT_EQ(std::count(calls.begin(), calls.end(), "open"), 1);
}

TEST_P(KmsSession, FollowsTheProjectorToAnotherConnector) {
    Evening evening(desk);
    evening.frames(3);
    desk.card.unplug(desk.hdmi);
    desk.card.plug(desk.other, projector_modes());
    evening.plugged();
    evening.frames(3);
    EXPECT_FALSE(desk.card.shown(desk.hdmi));
    EXPECT_TRUE(desk.card.shown(desk.other));
    EXPECT_EQ(evening.state(), "the projector at DP-1 is lit, 320 x 200 at 60 Hz");
}

TEST_P(KmsSession, PrefersTheRequestedModeToTheProjectorsPreferredOne) {
    {
        Evening evening(desk, wish(160, 120));
        evening.frames(3);
        EXPECT_EQ(evening.mode(), "160x120");
    }
    Evening evening(desk, wish(800, 600));
    evening.frames(3);
    EXPECT_EQ(evening.mode(), "320x200") << "the projector has no such mode";
    EXPECT_TRUE(holds(evening.state(), "cannot do the mode in the settings")) << evening.state();
    EXPECT_EQ(evening.health(), DeviceHealth::Impaired);
}

TEST_P(KmsSession, SignalsTheStereoLayoutByHdmiElseAsksForTheMenu) {
    const drmModeModeInfo plain = kernel_mode(320, 200, 60.0, true);
    OutputRequest halves = wish();
    const auto layout_shown = [&](EyeLayout eyes) {
        halves.eyes = eyes;
        Evening evening(desk, halves);
        evening.frames(3);
        EXPECT_EQ(evening.health(), DeviceHealth::Well);
        told_ = evening.state();
        const auto shown = desk.card.shown(desk.hdmi);
        return shown ? shown->mode.flags & DRM_MODE_FLAG_3D_MASK : DRM_MODE_FLAG_3D_MASK;
    };
    const std::string lit = "the projector at HDMI-A-1 is lit, 320 x 200 at 60 Hz";
    EXPECT_EQ(layout_shown(EyeLayout::SideBySide), 0U);
    EXPECT_EQ(told_, lit + "; choose 3D, side by side, in the projector's own menu");
    desk.card.plug(desk.hdmi, {in_3d(plain, DRM_MODE_FLAG_3D_FRAME_PACKING),
                               in_3d(plain, DRM_MODE_FLAG_3D_TOP_AND_BOTTOM),
                               in_3d(plain, DRM_MODE_FLAG_3D_SIDE_BY_SIDE_HALF), plain});
    EXPECT_EQ(layout_shown(EyeLayout::SideBySide), std::uint32_t{DRM_MODE_FLAG_3D_SIDE_BY_SIDE_HALF});
    EXPECT_EQ(told_, lit + "; HDMI tells it that the picture is 3D, side by side");
    EXPECT_EQ(layout_shown(EyeLayout::TopBottom), std::uint32_t{DRM_MODE_FLAG_3D_TOP_AND_BOTTOM});
    EXPECT_EQ(told_, lit + "; HDMI tells it that the picture is 3D, top and bottom");
    EXPECT_EQ(layout_shown(EyeLayout::One), 0U) << "the projector is switched back";
    EXPECT_EQ(told_, lit);
}

TEST_P(KmsSession, TriesTheNextModeWhenTheCardRefusesOne) {
    desk.card.max_khz = kernel_mode(256, 192, 60.0).clock;
    Evening evening(desk);
    evening.frames(3);
    EXPECT_EQ(evening.mode(), "256x192");
    desk.card.max_khz = 1;
    desk.card.plug(desk.hdmi, {kernel_mode(320, 200, 60.0), kernel_mode(160, 120, 60.0)});
    evening.plugged();
    evening.frames(3);
    EXPECT_TRUE(holds(evening.state(), "refuses every mode of the projector at HDMI-A-1")) << evening.state();
    EXPECT_FALSE(evening.lit());
}

TEST_P(KmsSession, LetsAScalingCardShowThePictureInItsOwnSize) {
    desk.card.scales = true;
    Evening evening(desk, wish(256, 192));
    evening.frames(3);
    EXPECT_EQ(evening.mode(), "256x192");
    EXPECT_EQ(desk.card.value(desk.planes[0], "SRC_W") >> 16U, GetParam() ? 320U : 256U);
}

TEST_P(KmsSession, ReportsAMissingProjectorModeOrMemory) {
    desk.card.unplug(desk.hdmi);
    Evening evening(desk);
    evening.frames(2);
    EXPECT_TRUE(holds(evening.state(), "no projector is connected")) << evening.state();
    desk.card.plug(desk.hdmi, {});
    evening.frames(2);
    EXPECT_TRUE(holds(evening.state(), "HDMI-A-1 names no mode; set display.mode")) << evening.state();
    kernel.fail_always("drmModeCreateDumbBuffer", ENOSYS);
    desk.card.plug(desk.hdmi, projector_modes());
    evening.frames(2);
    EXPECT_TRUE(holds(evening.state(), "no memory")) << evening.state();
    kernel.fail_always("drmModeCreateDumbBuffer", 0);
    evening.frames(5);
    EXPECT_EQ(evening.mode(), "320x200");
}

TEST_P(KmsSession, AddsFramebuffersByDepthForAnOldDriver) {
    desk.card.knows_fourcc = false;
    Evening evening(desk);
    evening.frames(3);
    EXPECT_EQ(evening.mode(), "320x200");
}

TEST_P(KmsSession, WaitsForAnotherProgramThatHoldsTheScreen) {
    Evening evening(desk);
    evening.frames(3);
    desk.card.drop_master();
    evening.frames(1);
    EXPECT_TRUE(holds(evening.state(), "another program holds the screen")) << evening.state();
    evening.frames(6);
    EXPECT_TRUE(holds(evening.state(), "is lit")) << evening.state();
}

TEST_P(KmsSession, RequestsARestartWhenARemovedCardIsBack) {
    Evening evening(desk);
    evening.frames(3);
    desk.card.gone = true;
    evening.frames(3);
    EXPECT_TRUE(holds(evening.state(), "the graphics card is gone")) << evening.state();
    EXPECT_EQ(evening.end(), "");
    desk.card.gone = false;
    kernel.fail(kernel.calls().size() + 1, ENODEV);
    evening.frames(1);
    EXPECT_TRUE(holds(evening.end(), "must be restarted")) << evening.end();
}

/// Only the test's clock advances.
TEST_P(KmsSession, GivesUpAMissingFlipAndFinallyTheCard) {
    const KmsCard card = KmsCard::open(card_path, {}).value();
    const CardSeen seen = card.look(true);
    const std::unique_ptr<KmsDevice> kms = make_kms_device(card);
    OnTestClock clock(*kms);
    Presenter presenter(
        clock, [&card](PixelSize size) { return UndrawnPair::make(card.file(), size); }, wish());
    presenter.connected(seen);
    const auto present = [&] {
        const Result<MonotonicTime> shown = presenter.present({0, 0, 320, 200}, true);
        clock.time += std::chrono::milliseconds(100);
        return shown ? std::string() : shown.error().message;
    };
    EXPECT_EQ(present(), "");
    desk.card.refresh();
    EXPECT_EQ(present(), "");
    const MonotonicTime before = clock.time;
    EXPECT_EQ(present(), "");
    EXPECT_EQ(present(), "");
    EXPECT_TRUE(holds(presenter.state(), "does not show the last picture")) << presenter.state();
    EXPECT_LE(clock.time - before, flip_timeout + std::chrono::milliseconds(300)) << "it waits once";
    std::string end;
    while (end.empty() && clock.time - before < 2 * stuck_given_up) {
        end = present();
    }
    if (GetParam()) {
        EXPECT_TRUE(holds(end, "has taken no picture for 10 s")) << end;
    } else {
        EXPECT_EQ(end, "") << "SETCRTC blocks until the flip is done, and lights it again";
    }
}

/// If any one call fails once, the picture is on the screen in the end or a sentence says why the program
/// must end; and nothing leaks.
TEST_P(KmsSession, RecoversFromOrReportsAnySingleFailedCall) {
    const bool atomic = GetParam();
    struct Outcome {
        std::vector<std::string> calls;
        std::string wrongs;
    };
    const auto run = [atomic](FakeKernel& own, CardOnDesk& card) {
        card.card.atomic = atomic;
        card.card.flips_at_once = false;
        std::string wrong;
        {
            Evening evening(card);
            evening.frames(4);
            card.card.unplug(card.hdmi);
            evening.plugged();
            evening.frames(1);
            card.card.plug(card.hdmi, projector_modes());
            evening.plugged();
            evening.frames(2);
            evening.frames(4, true);
            if (evening.end().empty() && evening.lit()) {
                wrong += "lit while it sleeps: " + evening.state() + "; ";
            }
            evening.frames(2);
            for (int k = 0; k < 8 && !holds(evening.state(), " is lit"); ++k) {
                evening.frames(1);
            }
            if (evening.end().empty() && (!evening.lit() || !holds(evening.state(), " is lit"))) {
                wrong += "dark in the end: " + evening.state() + "; ";
            }
            if (!evening.end().empty() && !holds(evening.end(), "display: ")) {
                wrong += "ends with " + evening.end() + "; ";
            }
        }
        return wrong + own.alive() + own.wrongs();
    };
    const auto once = [&run](std::size_t call, int error) {
        FakeKernel own;
        CardOnDesk card(own.add_card(card_path));
        own.fail(call, error);
        std::string wrong = run(own, card);
        return Outcome{own.calls(), std::move(wrong)};
    };
    const Outcome undisturbed = once(0, 0);
    ASSERT_EQ(undisturbed.wrongs, "");
    int runs = 0;
    for (std::size_t k = 1; k <= undisturbed.calls.size(); ++k) {
        const std::string& call = undisturbed.calls[k - 1];
        for (const int error : FakeKernel::errors_of(call)) {
            const Outcome disturbed = once(k, error);
            ASSERT_GE(disturbed.calls.size(), k);
            EXPECT_EQ(disturbed.wrongs, "") << "call " << k << ", " << call << ": " << error;
            ++runs;
        }
    }
    EXPECT_GT(static_cast<std::size_t>(runs), undisturbed.calls.size());
}

} // namespace
} // namespace frustumscreen::display
