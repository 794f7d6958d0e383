// Modes and flips, by atomic commits and by the kernel's legacy calls.
#include "tests/display/fake_desk.h"

#include <sys/socket.h>
#include <unistd.h>

namespace frustumscreen::display {
namespace {

/// `GetParam`: whether the driver has atomic commits.
class Device : public Desk, public testing::WithParamInterface<bool> {
protected:
    Device() {
        desk.card.atomic = GetParam();
        desk.card.flips_at_once = false;
        card_ = KmsCard::open(card_path, {}).value();
        static_cast<void>(card_->look(true));
        kms_ = make_kms_device(*card_);
    }
    FramebufferId framebuffer(int width = 320, int height = 200) {
        buffers_.push_back(DumbBuffer::create(card_->file(), {width, height}).value());
        return buffers_.back().shown();
    }
    /// A picture that is shown, and whose flip was received.
    FramebufferId lit() {
        const FramebufferId picture = framebuffer();
        EXPECT_EQ(light(picture), KmsAnswer::Done);
        static_cast<void>(done());
        return picture;
    }
    KmsAnswer light(FramebufferId shown, int width = 320, int height = 200, std::uint64_t ticket = 1) {
        return kms_->light(desk.hdmi, a_mode(width, height, 60.0),
                           {shown, {width, height}, {0, 0, width, height}}, ticket);
    }
    /// The tickets of all completed flips.
    std::vector<std::uint64_t> done() {
        desk.card.refresh();
        std::vector<std::uint64_t> tickets;
        while (const std::optional<Flipped> flipped = kms_->wait_flip(Nanoseconds(0))) {
            tickets.push_back(flipped->ticket);
        }
        return tickets;
    }
    /// An earlier program shows a picture at the other connector.
    void light_the_other() {
        const drmModeModeInfo mode = kernel_mode(320, 200, 60.0);
        ASSERT_EQ(desk.card.set_crtc(desk.crtcs[1], framebuffer(), std::array{desk.other}, &mode), 0);
        ASSERT_TRUE(desk.card.shown(desk.other));
    }
    [[nodiscard]] FramebufferId shown() const {
        const auto screen = desk.card.shown(desk.hdmi);
        return screen ? screen->framebuffer : 0;
    }
    void send(const void* bytes, std::size_t length) {
        ASSERT_EQ(::write(kernel.file(card_->file())->events, bytes, length), static_cast<ssize_t>(length));
    }

    std::optional<KmsCard> card_;
    std::vector<DumbBuffer> buffers_;
    std::unique_ptr<KmsDevice> kms_;
};

TEST_P(Device, LightsOnlyTheProjector) {
    light_the_other();
    const FramebufferId picture = framebuffer();
    EXPECT_EQ(light(picture), KmsAnswer::Done);
    EXPECT_EQ(desk.card.shown(desk.hdmi), (FakeCard::Shown{picture, kernel_mode(320, 200, 60.0)}));
    EXPECT_FALSE(desk.card.shown(desk.other));
    EXPECT_EQ(desk.card.value(desk.crtcs[1], "ACTIVE"), 0U);
    EXPECT_EQ(done(), std::vector<std::uint64_t>{1}) << "the other CRTC's flip is not ours";
    EXPECT_EQ(desk.card.value(desk.hdmi, "Broadcast RGB"), 1U) << "Full";
    EXPECT_EQ(kms_->shortcoming(), "");
}

TEST_P(Device, AlternatesTwoFramebuffers) {
    const std::array<FramebufferId, 2> pictures{framebuffer(), framebuffer()};
    ASSERT_EQ(light(pictures[0]), KmsAnswer::Done);
    EXPECT_EQ(done(), std::vector<std::uint64_t>{1});
    for (std::uint64_t ticket = 2; ticket < 6; ++ticket) {
        EXPECT_EQ(kms_->flip(pictures[ticket % 2], ticket), KmsAnswer::Done);
        EXPECT_FALSE(kms_->wait_flip(Nanoseconds(0)));
        EXPECT_EQ(kms_->flip(pictures[(ticket + 1) % 2], 100), KmsAnswer::Busy) << "one flip at a time";
        EXPECT_EQ(shown(), pictures[ticket % 2]);
        EXPECT_EQ(done(), std::vector<std::uint64_t>{ticket});
        EXPECT_TRUE(kms_->flips_keep_time());
    }
    EXPECT_EQ(desk.card.removed_while_shown(), 0);
}

TEST_P(Device, ReportsTheCardsTimeOfAFlip) {
    const FramebufferId picture = lit();
    ASSERT_EQ(kms_->flip(picture, 2), KmsAnswer::Done);
    desk.card.time_us = 7'000'000;
    desk.card.refresh();
    const std::optional<Flipped> flipped = kms_->wait_flip(Nanoseconds(0));
    ASSERT_TRUE(flipped);
    EXPECT_EQ(flipped->time, from_microseconds(7'016'667));
}

TEST_P(Device, UsesItsOwnClockIfTheCardsIsNotMonotonic) {
    desk.card.monotonic = false;
    kms_ = make_kms_device(*card_);
    const FramebufferId picture = lit();
    ASSERT_EQ(kms_->flip(picture, 2), KmsAnswer::Done);
    const MonotonicTime before = kms_->now();
    desk.card.refresh();
    const std::optional<Flipped> flipped = kms_->wait_flip(Nanoseconds(0));
    ASSERT_TRUE(flipped);
    EXPECT_GE(flipped->time, before);
    EXPECT_FALSE(kms_->flips_keep_time());
}

TEST_P(Device, FlipsKeepNoTimeWithoutVerticalBlanks) {
    desk.card.vertical_blanks = false;
    const FramebufferId picture = lit();
    ASSERT_EQ(kms_->flip(picture, 2), KmsAnswer::Done);
    EXPECT_EQ(done(), std::vector<std::uint64_t>{2});
    EXPECT_FALSE(kms_->flips_keep_time());
}

TEST_P(Device, IgnoresForeignAndMalformedEvents) {
    lit();
    drm_event_vblank event{};
    event.base = {DRM_EVENT_VBLANK, sizeof event};
    event.crtc_id = desk.crtcs[0];
    send(&event, sizeof event);
    event.base = {DRM_EVENT_FLIP_COMPLETE, sizeof event};
    event.crtc_id = desk.crtcs[1];
    send(&event, sizeof event);
    event.base.length = 4; // shorter than its header
    send(&event, sizeof event);
    event.base.length = 200; // longer than the data
    send(&event, sizeof event);
    send(&event, 3);
    EXPECT_TRUE(done().empty());
    event.base.length = sizeof event;
    event.crtc_id = 0; // a driver that does not name the CRTC
    event.user_data = 77;
    const std::array two{event, event};
    send(two.data(), sizeof two);
    EXPECT_EQ(done(), (std::vector<std::uint64_t>{77, 77}));
}

TEST_P(Device, WaitEndsWhenTheEventFileIsClosed) {
    ASSERT_EQ(::shutdown(kernel.file(card_->file())->events, SHUT_WR), 0);
    EXPECT_FALSE(kms_->wait_flip(Nanoseconds(0)));
    EXPECT_FALSE(kms_->wait_flip(std::chrono::milliseconds(1)));
}

TEST_P(Device, DarkensAndLightsAgain) {
    const FramebufferId picture = framebuffer();
    EXPECT_EQ(kms_->darken(), KmsAnswer::Done) << "nothing is lit";
    EXPECT_EQ(kms_->flip(picture, 1), KmsAnswer::Refused);
    ASSERT_EQ(light(picture), KmsAnswer::Done);
    static_cast<void>(done());
    EXPECT_EQ(kms_->darken(), KmsAnswer::Done);
    EXPECT_FALSE(desk.card.shown(desk.hdmi));
    EXPECT_EQ(desk.card.value(desk.crtcs[0], "MODE_ID"), 0U);
    EXPECT_EQ(kms_->flip(picture, 2), KmsAnswer::Refused);
    EXPECT_TRUE(done().empty());
    EXPECT_EQ(light(picture, 320, 200, 3), KmsAnswer::Done);
    EXPECT_EQ(done(), std::vector<std::uint64_t>{3});
}

TEST_P(Device, RefusesAModeThatIsTooFastAndTakesASlowerOne) {
    const FramebufferId large = framebuffer();
    const FramebufferId small = framebuffer(160, 120);
    desk.card.max_khz = kernel_mode(160, 120, 60.0).clock;
    EXPECT_EQ(light(large), KmsAnswer::Refused);
    EXPECT_EQ(shown(), 0U);
    EXPECT_EQ(light(small, 160, 120), KmsAnswer::Done);
    EXPECT_EQ(shown(), small);
}

TEST_P(Device, MapsKernelErrorsToAnswers) {
    const FramebufferId picture = framebuffer();
    const std::string call = GetParam() ? "drmModeAtomicCommit" : "drmModeSetCrtc";
    const std::string flip = GetParam() ? "drmModeAtomicCommit" : "drmModePageFlip";
    using enum KmsAnswer;
    for (const auto& [error, answer] : {std::pair{EBUSY, Busy},
                                        {EINTR, Busy},
                                        {EAGAIN, Busy},
                                        {EACCES, NotMaster},
                                        {EPERM, NotMaster},
                                        {ENODEV, Gone},
                                        {ENXIO, Gone},
                                        {EIO, Gone},
                                        {EINVAL, Refused},
                                        {ENOSPC, Refused},
                                        {ENOMEM, Refused}}) {
        kernel.fail_always(call, error);
        EXPECT_EQ(light(picture), answer) << error;
        kernel.fail_always(call, 0);
        ASSERT_EQ(light(picture), Done);
        static_cast<void>(done());
        kernel.fail_always(flip, error);
        EXPECT_EQ(kms_->flip(picture, 2), answer) << error;
        kernel.fail_always(flip, 0);
        kernel.fail_always(call, error);
        EXPECT_EQ(kms_->darken(), answer) << error;
        kernel.fail_always(call, 0);
        EXPECT_EQ(kms_->darken(), Done) << "it is still known what is lit";
        static_cast<void>(done());
    }
}

TEST_P(Device, ReportsARemovedCardAsGone) {
    const FramebufferId picture = lit();
    desk.card.gone = true;
    EXPECT_EQ(kms_->flip(picture, 2), KmsAnswer::Gone);
    EXPECT_EQ(light(picture), KmsAnswer::Gone);
    EXPECT_EQ(kms_->darken(), KmsAnswer::Gone);
    desk.card.gone = false;
}

TEST_P(Device, ARemovedFramebufferIsNoLongerShown) {
    lit();
    buffers_.clear();
    EXPECT_EQ(shown(), 0U);
    EXPECT_EQ(kms_->flip(framebuffer(), 2), GetParam() ? KmsAnswer::Refused : KmsAnswer::Busy)
        << "drm_mode_page_flip_ioctl has EBUSY for it";
}

TEST_P(Device, ReportsAFixedColourRangeOnlyInATelevisionsMode) {
    desk.card.fixed = {"Broadcast RGB"};
    EXPECT_EQ(light(framebuffer(1280, 720), 1280, 720), KmsAnswer::Done) << "a lit screen is worth more";
    EXPECT_NE(kms_->shortcoming().find("HDMI's range"), std::string_view::npos) << kms_->shortcoming();
    static_cast<void>(done());
    EXPECT_EQ(light(framebuffer(), 320, 200), KmsAnswer::Done);
    EXPECT_EQ(kms_->shortcoming(), "") << "not a television's mode";
}

TEST_P(Device, RefusesAConnectorWithoutACrtcOrThatIsUnknown) {
    const std::uint32_t orphan = desk.card.add_connector(DRM_MODE_CONNECTOR_VGA, 1, {}).id;
    const FramebufferId picture = framebuffer();
    EXPECT_EQ(kms_->light(orphan, a_mode(320, 200, 60.0), {picture, {320, 200}, {0, 0, 320, 200}}, 1),
              KmsAnswer::Refused);
    EXPECT_EQ(kms_->light(9999, a_mode(320, 200, 60.0), {picture, {320, 200}, {0, 0, 320, 200}}, 1),
              KmsAnswer::Refused);
}

TEST_P(Device, ScalesAPictureOfAnotherSizeOrRefusesIt) {
    const FramebufferId picture = framebuffer();
    const ScannedOut scaled{picture, {320, 200}, {0, 20, 256, 160}};
    EXPECT_EQ(kms_->light(desk.hdmi, a_mode(256, 192, 60.0), scaled, 1), KmsAnswer::Refused);
    desk.card.scales = true;
    EXPECT_EQ(kms_->light(desk.hdmi, a_mode(256, 192, 60.0), scaled, 1),
              GetParam() ? KmsAnswer::Done : KmsAnswer::Refused);
}

INSTANTIATE_TEST_SUITE_P(Kms, Device, testing::Bool(),
                         [](const auto& tested) { return tested.param ? "Atomic" : "Legacy"; });

using AtomicDevice = Device;
INSTANTIATE_TEST_SUITE_P(Kms, AtomicDevice, testing::Values(true));

TEST_P(AtomicDevice, ResetsThePropertiesThatAnEarlierProgramLeft) {
    const FramebufferId picture = framebuffer();
    desk.card.set(desk.crtcs[0], "VRR_ENABLED", 1);
    desk.card.set(desk.hdmi, "link-status", 1);
    desk.card.set(desk.planes[0], "CRTC_X", 5);
    ASSERT_EQ(light(picture), KmsAnswer::Done);
    EXPECT_EQ(desk.card.value(desk.planes[0], "rotation"), std::uint64_t{DRM_MODE_ROTATE_0});
    EXPECT_EQ(desk.card.value(desk.planes[0], "alpha"), 0xFFFFU);
    EXPECT_EQ(desk.card.value(desk.planes[0], "CRTC_X"), 0U);
    EXPECT_EQ(desk.card.value(desk.crtcs[0], "VRR_ENABLED"), 0U);
    EXPECT_EQ(desk.card.value(desk.hdmi, "link-status"), 0U);
}

TEST_P(AtomicDevice, TurnsOffAnOverlayOfAnEarlierProgram) {
    const FramebufferId picture = lit();
    desk.card.set(desk.overlay, "FB_ID", picture);
    desk.card.set(desk.overlay, "CRTC_ID", desk.crtcs[0]);
    ASSERT_EQ(light(picture), KmsAnswer::Done);
    EXPECT_EQ(desk.card.value(desk.overlay, "CRTC_ID"), 0U);
}

TEST_P(AtomicDevice, RefusesACardThatLacksARequiredProperty) {
    const FramebufferId picture = framebuffer();
    const auto lights_without = [&](std::uint32_t object, const std::string& name) {
        const FakeProperty property = *desk.card.property(desk.card.id_of(object, name));
        const std::uint64_t value = desk.card.value(object, name);
        desk.card.take_property(object, name);
        const KmsAnswer answer = light(picture);
        static_cast<void>(done());
        EXPECT_EQ(answer == KmsAnswer::Done, shown() == picture) << name;
        static_cast<void>(kms_->darken());
        static_cast<void>(done());
        desk.card.add_property(object, property, value);
        return answer == KmsAnswer::Done;
    };
    for (const char* name : {"FB_ID", "CRTC_ID", "SRC_W", "SRC_H", "CRTC_W", "CRTC_H"}) {
        EXPECT_FALSE(lights_without(desk.planes[0], name)) << name;
    }
    for (const char* name : {"ACTIVE", "MODE_ID"}) {
        EXPECT_FALSE(lights_without(desk.crtcs[0], name)) << name;
    }
    EXPECT_FALSE(lights_without(desk.hdmi, "CRTC_ID"));
    EXPECT_TRUE(lights_without(desk.hdmi, "link-status")) << "old drivers have none";
    EXPECT_TRUE(lights_without(desk.planes[0], "rotation"));
    EXPECT_TRUE(lights_without(desk.planes[0], "type")) << "the other CRTC has a primary plane too";
}

TEST_P(AtomicDevice, FlipsToOtherRowsOfAFramebuffer) {
    const FramebufferId both = framebuffer(320, 400);
    EXPECT_EQ(kms_->flip_from(200, both, 1), KmsAnswer::Refused) << "nothing is lit";
    ASSERT_EQ(light(both), KmsAnswer::Done);
    static_cast<void>(done());
    EXPECT_EQ(kms_->flip_from(200, both, 2), KmsAnswer::Done);
    EXPECT_EQ(done(), std::vector<std::uint64_t>{2});
    EXPECT_EQ(desk.card.value(desk.planes[0], "SRC_Y"), std::uint64_t{200} << 16U);
    EXPECT_EQ(kms_->flip_from(201, both, 3), KmsAnswer::Refused) << "its last row is above the screen's";
    EXPECT_EQ(kms_->flip_from(0, both, 4), KmsAnswer::Done);
    EXPECT_EQ(done(), std::vector<std::uint64_t>{4});
    EXPECT_EQ(desk.card.value(desk.planes[0], "SRC_Y"), 0U);
    EXPECT_EQ(kms_->flip_from(200, both, 5), KmsAnswer::Done);
    static_cast<void>(done());
    ASSERT_EQ(light(both, 320, 200, 6), KmsAnswer::Done);
    EXPECT_EQ(desk.card.value(desk.planes[0], "SRC_Y"), 0U) << "a new mode begins with the first row";
    static_cast<void>(done());
}

TEST_P(Device, ReportsTheRefreshNumberOfAFlip) {
    const FramebufferId picture = lit();
    desk.card.refreshes = 40;
    ASSERT_EQ(kms_->flip(picture, 2), KmsAnswer::Done);
    desk.card.refresh();
    const std::optional<Flipped> flipped = kms_->wait_flip(Nanoseconds(0));
    ASSERT_TRUE(flipped);
    EXPECT_EQ(flipped->refresh, 41U);
    EXPECT_EQ(kms_->card(), card_path);
    EXPECT_FALSE(kms_->in_turn());
}

TEST_P(AtomicDevice, RefusesACardWithoutAPrimaryPlane) {
    FakeCard& card = kernel.add_card("/dev/dri/fake1");
    const std::uint32_t crtc = card.add_crtc();
    const std::uint32_t connector = card.add_connector(DRM_MODE_CONNECTOR_HDMIA, 1, {card.add_encoder(1)}).id;
    card.add_plane(DRM_PLANE_TYPE_CURSOR, 1);
    const KmsCard opened = KmsCard::open("fake1", {}).value();
    const std::unique_ptr<KmsDevice> kms = make_kms_device(opened);
    EXPECT_EQ(kms->light(connector, a_mode(320, 200, 60.0), {1, {320, 200}, {0, 0, 320, 200}}, 1),
              KmsAnswer::Refused);
    EXPECT_EQ(card.value(crtc, "ACTIVE"), 0U);
}

} // namespace
} // namespace frustumscreen::display
