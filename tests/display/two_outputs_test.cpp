// The projector and the screen, at two connectors of one card or at two cards, on the fake kernel.
#include "tests/display/fake_desk.h"

namespace frustumscreen::display {
namespace {

constexpr Nanoseconds one_frame = std::chrono::milliseconds(20);

bool holds(std::string_view text, std::string_view words) {
    return text.find(words) != std::string_view::npos;
}

OutputRequest wish(const std::string& connector) {
    OutputRequest request;
    request.connector = connector;
    request.picture_width = 320;
    request.picture_height = 200;
    return request;
}

/// One output on an open card, as KmsDisplay has it, on the test's clock.
class Output {
public:
    Output(KmsCard card, OutputRequest request)
        : request_(std::move(request)), card_(std::move(card)), kms_(make_kms_device(card_)), clock_(*kms_),
          presenter_(
              clock_, [this](PixelSize size) { return UndrawnPair::make(card_.memory_file(), size); },
              request_) {}

    void plugged() { see(card_.look(true)); }
    /// As ConnectorWatch does.
    void look() {
        if (CardSeen seen = card_.look(!presenter_.lit()); seen != seen_) {
            see(std::move(seen));
        }
    }
    /// One frame of the loop: nothing is presented while the card still has the picture before.
    void frame() {
        if (end.empty() && presenter_.takes_picture()) {
            const MonotonicTime before = clock_.time;
            const Result<MonotonicTime> shown = presenter_.present({0, 0, 320, 200}, true);
            EXPECT_EQ(clock_.time, before) << "it waited";
            end = shown ? "" : shown.error().message;
            ++presented;
        }
        clock_.time += one_frame;
    }
    [[nodiscard]] KmsCard& card() { return card_; }
    [[nodiscard]] Presenter& presenter() { return presenter_; }
    [[nodiscard]] std::string says() const { return std::string(presenter_.state()); }
    [[nodiscard]] MonotonicTime time() const { return clock_.time; }

    int presented = 0;
    std::string end; ///< why it must be opened again; empty: it goes on

private:
    void see(CardSeen seen) {
        seen_ = seen;
        presenter_.connected(std::move(seen));
    }

    CardSeen seen_;
    OutputRequest request_;
    KmsCard card_;
    std::unique_ptr<KmsDevice> kms_;
    OnTestClock clock_;
    Presenter presenter_;
};

/// `GetParam`: whether the driver has atomic commits. The projector is at HDMI, the screen at DisplayPort.
class TwoOutputs : public Desk, public testing::WithParamInterface<bool> {
protected:
    TwoOutputs() {
        desk.card.atomic = GetParam();
        desk.card.flips_at_once = false;
        desk.card.plug(desk.other, {kernel_mode(256, 192, 60.0, true)});
    }
    void open() {
        const OutputRequest request = wish("HDMI-A-1");
        projector.emplace(KmsCard::open(card_path, request).value(), request);
        const OutputRequest beside = wish("DP-1");
        Result<KmsCard> lease = projector->card().lease(beside, "HDMI-A-1");
        ASSERT_TRUE(lease) << lease.error().message;
        screen.emplace(std::move(*lease), beside);
        projector->plugged();
        screen->plugged();
    }
    void frames(int count) {
        for (int k = 0; k < count; ++k) {
            projector->frame();
            screen->frame();
            desk.card.refresh();
        }
        EXPECT_EQ(projector->end, "");
        EXPECT_EQ(screen->end, "");
    }
    [[nodiscard]] int width_at(std::uint32_t connector) const {
        const auto shown = desk.card.shown(connector);
        return shown ? shown->mode.hdisplay : 0;
    }

    std::optional<Output> projector, screen;
};
INSTANTIATE_TEST_SUITE_P(Kms, TwoOutputs, testing::Bool(),
                         [](const auto& tested) { return tested.param ? "Atomic" : "Legacy"; });

TEST_P(TwoOutputs, LightsBothEachInItsMode) {
    open();
    frames(5);
    EXPECT_EQ(width_at(desk.hdmi), 320);
    EXPECT_EQ(width_at(desk.other), 256);
    EXPECT_NE(desk.card.shown(desk.hdmi)->framebuffer, desk.card.shown(desk.other)->framebuffer);
    EXPECT_EQ(projector->says(), "the projector at HDMI-A-1 is lit, 320 x 200 at 60 Hz");
    EXPECT_EQ(screen->says(), "the projector at DP-1 is lit, 256 x 192 at 60 Hz");
    const int before = projector->presented;
    frames(20);
    EXPECT_EQ(projector->presented, before + 20);
    EXPECT_EQ(screen->presented, before + 20);
    EXPECT_EQ(desk.card.removed_while_shown(), 0);
}

TEST_P(TwoOutputs, ReplugOfOneDoesNotInterruptTheOther) {
    open();
    frames(5);
    const auto goes_on_without = [this](std::uint32_t connector, Output& pulled, Output& other,
                                        std::uint32_t others, std::vector<drmModeModeInfo> modes) {
        const auto shown = desk.card.shown(others);
        desk.card.unplug(connector);
        pulled.plugged();
        const int before = other.presented;
        frames(10);
        EXPECT_EQ(width_at(connector), 0);
        EXPECT_TRUE(holds(pulled.says(), "is connected to")) << pulled.says();
        EXPECT_EQ(pulled.presenter().condition().health, DeviceHealth::Away);
        desk.card.plug(connector, std::move(modes));
        pulled.plugged();
        frames(10);
        EXPECT_TRUE(holds(pulled.says(), "is lit")) << pulled.says();
        EXPECT_EQ(other.presented, before + 20) << "each of its frames was shown";
        EXPECT_TRUE(holds(other.says(), "is lit")) << other.says();
        EXPECT_EQ(desk.card.shown(others)->mode.hdisplay, shown->mode.hdisplay);
    };
    goes_on_without(desk.other, *screen, *projector, desk.hdmi, {kernel_mode(160, 120, 60.0, true)});
    EXPECT_EQ(width_at(desk.other), 160) << "another screen";
    goes_on_without(desk.hdmi, *projector, *screen, desk.other, projector_modes());
    EXPECT_EQ(width_at(desk.hdmi), 320);
}

TEST_P(TwoOutputs, AnOutputThatSleepsLeavesTheOtherLit) {
    open();
    frames(5);
    for (int k = 0; k < 3; ++k) {
        EXPECT_TRUE(screen->presenter().stay_dark(true));
        projector->frame();
        desk.card.refresh();
    }
    EXPECT_EQ(width_at(desk.other), 0);
    EXPECT_EQ(screen->says(), "the projector is dark on purpose");
    EXPECT_EQ(width_at(desk.hdmi), 320);
}

TEST_P(TwoOutputs, DoesNotWaitForAMissingFlipAndReportsIt) {
    open();
    frames(5);
    ASSERT_TRUE(screen->presenter().present({0, 0, 320, 200}, true)); // its flip never comes
    const MonotonicTime before = screen->time();
    const int presented = screen->presented;
    int frames_until_told = 0;
    while (!holds(screen->says(), "does not show the last picture") && frames_until_told < 100) {
        screen->frame();
        ++frames_until_told;
    }
    EXPECT_NEAR(frames_until_told, flip_timeout / one_frame, 2);
    EXPECT_EQ(screen->presented, presented);
    while (screen->presented == presented && screen->time() - before < 2 * flip_given_up) {
        screen->frame();
    }
    EXPECT_GE(screen->time() - before, flip_given_up);
    EXPECT_EQ(screen->presented, presented + 1) << "it is lit again";
}

TEST_P(TwoOutputs, ReplacesThePictureOfAnEarlierProgram) {
    KmsCard earlier = KmsCard::open(card_path, {}).value();
    std::optional<DumbBuffer> buffer = DumbBuffer::create(earlier.file(), {320, 200});
    ASSERT_TRUE(buffer);
    const drmModeModeInfo mode = kernel_mode(320, 200, 60.0);
    // HDMI is fed by the only CRTC that can feed DisplayPort.
    ASSERT_EQ(desk.card.set_crtc(desk.crtcs[1], buffer->shown(), std::array{desk.hdmi}, &mode), 0);
    desk.card.drop_master();
    open();
    frames(5);
    EXPECT_EQ(width_at(desk.hdmi), 320);
    EXPECT_EQ(width_at(desk.other), 256);
    EXPECT_EQ(desk.card.value(desk.other, "CRTC_ID"), desk.crtcs[1]);
}

TEST_P(TwoOutputs, EachProbesOnlyItsOwnConnector) {
    open();
    frames(3);
    desk.card.unplug(desk.other);
    static_cast<void>(projector->card().look(true));
    EXPECT_EQ(desk.card.connector(desk.other).known, DRM_MODE_CONNECTED);
    const CardSeen seen = screen->card().look(true);
    ASSERT_EQ(seen.connectors.size(), 1U);
    EXPECT_EQ(seen.connectors[0].name, "DP-1");
    EXPECT_EQ(seen.connectors[0].plugged, Plugged::No);
}

TEST_P(TwoOutputs, BothWaitForAnotherProgramThatHoldsTheCard) {
    open();
    frames(3);
    desk.card.drop_master();
    frames(2);
    EXPECT_TRUE(holds(screen->says(), "the exhibit goes on in the dark")) << screen->says();
    EXPECT_TRUE(holds(projector->says(), "the exhibit goes on in the dark")) << projector->says();
    frames(120);
    EXPECT_TRUE(holds(screen->says(), "is lit")) << screen->says();
    EXPECT_TRUE(holds(projector->says(), "is lit")) << projector->says();
}

TEST_P(TwoOutputs, ARefusedLeaseLeavesTheProjectorLit) {
    const OutputRequest request = wish("HDMI-A-1");
    Output alone(KmsCard::open(card_path, request).value(), request);
    const auto refused = [&](const std::string& connector) {
        const Result<KmsCard> lease = alone.card().lease(wish(connector), "HDMI-A-1");
        return lease ? std::string() : lease.error().message;
    };
    EXPECT_EQ(refused("DP-7"),
              "the graphics card /dev/dri/fake0 has no connector DP-7; it has HDMI-A-1, DP-1");
    kernel.fail_always("drmModeCreateLease", EOPNOTSUPP);
    EXPECT_TRUE(holds(refused("DP-1"), "cannot drive DP-1 separately from HDMI-A-1: Operation not supported"))
        << refused("DP-1");
    kernel.fail_always("drmModeCreateLease", 0);
    const std::uint32_t single = desk.card.add_encoder(0);
    desk.card.add_connector(DRM_MODE_CONNECTOR_VGA, 1, {single});
    EXPECT_TRUE(holds(refused("VGA-1"), "cannot light VGA-1 beside HDMI-A-1")) << refused("VGA-1");
    alone.plugged();
    for (int k = 0; k < 3; ++k) {
        alone.frame();
        desk.card.refresh();
    }
    EXPECT_EQ(width_at(desk.hdmi), 320);
}

TEST_P(TwoOutputs, AScreenThatIsClosedCanBeOpenedAgain) {
    open();
    frames(3);
    screen.reset();
    projector->frame();
    desk.card.refresh();
    EXPECT_EQ(width_at(desk.other), 0);
    Result<KmsCard> again = projector->card().lease(wish("DP-1"), "HDMI-A-1");
    ASSERT_TRUE(again) << again.error().message;
    screen.emplace(std::move(*again), wish("DP-1"));
    screen->plugged();
    frames(5);
    EXPECT_EQ(width_at(desk.other), 256);
    EXPECT_EQ(width_at(desk.hdmi), 320);
}

TEST_P(TwoOutputs, TheScreensFileOutlivesTheProjectors) {
    open();
    frames(3);
    projector.reset();
    screen->frame();
    EXPECT_EQ(width_at(desk.other), 256);
}

/// An exhibit with both outputs, whose screen is pulled and put back. Describes what is wrong in the end.
std::string evening(FakeKernel& kernel, CardOnDesk& desk) {
    const OutputRequest request = wish("HDMI-A-1");
    const OutputRequest beside = wish("DP-1");
    std::string wrong;
    {
        Result<KmsCard> card = KmsCard::open(card_path, request);
        if (!card) {
            return kernel.alive() + kernel.wrongs();
        }
        Output projector(std::move(*card), request);
        Result<KmsCard> lease = projector.card().lease(beside, "HDMI-A-1");
        std::optional<Output> screen;
        if (lease) {
            screen.emplace(std::move(*lease), beside);
        }
        const auto lit = [](const Output& output) { return holds(output.says(), " is lit"); };
        const auto frames = [&](int count) {
            for (int k = 0; k < count; ++k) {
                for (Output* output : {&projector, screen ? &*screen : nullptr}) {
                    if (output != nullptr) {
                        output->look();
                        output->frame();
                    }
                }
                desk.card.refresh();
            }
        };
        frames(4);
        desk.card.unplug(desk.other);
        if (screen) {
            screen->plugged();
        }
        frames(4);
        desk.card.plug(desk.other, projector_modes());
        if (screen) {
            screen->plugged();
        }
        frames(4);
        const auto done = [&](const Output& output) { return lit(output) || !output.end.empty(); };
        for (int k = 0; k < 200 && !(done(projector) && (!screen || done(*screen))); ++k) {
            frames(1);
        }
        wrong +=
            projector.end.empty() && !desk.card.shown(desk.hdmi) ? "no projector: " + projector.says() : "";
        wrong += screen && screen->end.empty() && !desk.card.shown(desk.other)
                     ? "no screen: " + screen->says()
                     : "";
    }
    return wrong + kernel.alive() + kernel.wrongs();
}

/// If any one call fails once, both outputs are lit in the end, unless one must be opened again; the other is lit then too.
TEST_P(TwoOutputs, RecoverFromAnySingleFailedCall) {
    const auto once = [](std::size_t call, int error, std::string& wrong) {
        FakeKernel own;
        CardOnDesk card(own.add_card(card_path));
        card.card.atomic = GetParam();
        card.card.flips_at_once = false;
        card.card.plug(card.other, projector_modes());
        own.fail(call, error);
        wrong = evening(own, card);
        return own.calls();
    };
    std::string wrong;
    const std::vector<std::string> calls = once(0, 0, wrong);
    ASSERT_EQ(wrong, "");
    for (std::size_t k = 1; k <= calls.size(); ++k) {
        for (const int error : FakeKernel::errors_of(calls[k - 1])) {
            once(k, error, wrong);
            EXPECT_EQ(wrong, "") << "call " << k << ", " << calls[k - 1] << ": " << error;
        }
    }
}

TEST_P(TwoOutputs, AreIndependentOnTwoCards) {
    CardOnDesk second(kernel.add_card("/dev/dri/fake1"));
    second.card.atomic = GetParam();
    second.card.flips_at_once = false;
    const OutputRequest request = wish("HDMI-A-1");
    const OutputRequest beside = wish("HDMI-A-1");
    projector.emplace(KmsCard::open(card_path, request).value(), request);
    screen.emplace(KmsCard::open("/dev/dri/fake1", beside).value(), beside);
    projector->plugged();
    screen->plugged();
    frames(3);
    EXPECT_EQ(width_at(desk.hdmi), 320);
    second.card.refresh();
    EXPECT_TRUE(second.card.shown(second.hdmi));
    second.card.gone = true;
    screen->plugged();
    const int before = projector->presented;
    frames(20);
    EXPECT_TRUE(holds(screen->says(), "the graphics card is gone; the exhibit goes on in the dark"))
        << screen->says();
    EXPECT_EQ(projector->presented, before + 20);
    EXPECT_TRUE(holds(projector->says(), "is lit")) << projector->says();
    second.card.gone = false;
    EXPECT_EQ(std::count(kernel.calls().begin(), kernel.calls().end(), "drmModeCreateLease"), 0);
}

} // namespace
} // namespace frustumscreen::display
