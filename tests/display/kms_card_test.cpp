// Which card is opened, and what is detected on it.
#include "firmware_host/display/kms_display.h"
#include "tests/base/temporary_folder.h"
#include "tests/display/fake_desk.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

namespace frustumscreen::display {
namespace {

namespace fs = std::filesystem;

OutputRequest asks_for(const std::string& connector) {
    OutputRequest request;
    request.connector = connector;
    return request;
}

bool holds(std::string_view text, std::string_view words) {
    return text.find(words) != std::string_view::npos;
}

using KmsCardTest = Desk;

TEST_F(KmsCardTest, ListsTheConnectors) {
    desk.card.connector(desk.other).cable = DRM_MODE_UNKNOWNCONNECTION;
    desk.card.add_connector(DRM_MODE_CONNECTOR_eDP, 1, {});
    desk.card.add_connector(DRM_MODE_CONNECTOR_WRITEBACK, 1, {});
    desk.card.add_connector(1000, 1, {}); // a type unknown to this libdrm
    desk.card.set(desk.hdmi, "link-status", 1);
    const Result<KmsCard> card = KmsCard::open(card_path, {});
    ASSERT_TRUE(card) << card.error().message;
    EXPECT_EQ(card->path(), card_path);
    EXPECT_TRUE(card->is_atomic());
    const CardSeen seen = card->look(true);
    EXPECT_EQ(seen.state, CardState::There);
    ASSERT_EQ(seen.connectors.size(), 4U);
    EXPECT_EQ(seen.connectors[0].name, "HDMI-A-1");
    EXPECT_EQ(seen.connectors[0].plugged, Plugged::Yes);
    EXPECT_TRUE(seen.connectors[0].link_bad);
    EXPECT_FALSE(seen.connectors[0].built_in);
    ASSERT_EQ(seen.connectors[0].modes.size(), 3U);
    ModeTiming preferred = a_mode(320, 200, 60.0);
    preferred.preferred = true;
    EXPECT_EQ(seen.connectors[0].modes[0], preferred);
    EXPECT_EQ(seen.connectors[1].name, "DP-1");
    EXPECT_EQ(seen.connectors[1].plugged, Plugged::Unknown);
    EXPECT_FALSE(seen.connectors[1].link_bad);
    EXPECT_TRUE(seen.connectors[2].built_in);
    EXPECT_EQ(seen.connectors[2].plugged, Plugged::No);
    EXPECT_EQ(seen.connectors[3].name, "Unknown-1");
}

TEST_F(KmsCardTest, AThoroughLookFindsChangesWithoutAnEvent) {
    const Result<KmsCard> card = KmsCard::open(card_path, {});
    ASSERT_TRUE(card);
    EXPECT_EQ(card->look(false).connectors[0].plugged, Plugged::No) << "the projector was not asked yet";
    EXPECT_EQ(card->look(true).connectors[0].plugged, Plugged::Yes);
    desk.card.unplug(desk.hdmi);
    EXPECT_EQ(card->look(false).connectors[0].plugged, Plugged::Yes);
    EXPECT_EQ(card->look(true).connectors[0].plugged, Plugged::No);
}

TEST_F(KmsCardTest, Hdmis3DModesAreListedOnlyForTwoHalves) {
    const drmModeModeInfo plain = kernel_mode(320, 200, 60.0, true);
    desk.card.plug(desk.hdmi, {plain, in_3d(plain, DRM_MODE_FLAG_3D_TOP_AND_BOTTOM),
                               in_3d(plain, DRM_MODE_FLAG_3D_SIDE_BY_SIDE_HALF),
                               in_3d(plain, DRM_MODE_FLAG_3D_FRAME_PACKING)});
    EXPECT_EQ(mode_top_bottom, std::uint32_t{DRM_MODE_FLAG_3D_TOP_AND_BOTTOM});
    EXPECT_EQ(mode_side_by_side, std::uint32_t{DRM_MODE_FLAG_3D_SIDE_BY_SIDE_HALF});
    EXPECT_EQ(mode_stereo, std::uint32_t{DRM_MODE_FLAG_3D_MASK});
    const auto listed = [this](EyeLayout eyes) {
        OutputRequest request;
        request.eyes = eyes;
        return KmsCard::open(card_path, request)->look(true).connectors[0].modes.size();
    };
    const auto capabilities = [this] {
        return std::count(kernel.calls().begin(), kernel.calls().end(), "drmSetClientCap");
    };
    EXPECT_EQ(listed(EyeLayout::One), 1U);
    EXPECT_EQ(listed(EyeLayout::InTurn), 1U);
    EXPECT_EQ(capabilities(), 4) << "universal planes and atomic commits, and no more";
    EXPECT_EQ(listed(EyeLayout::SideBySide), 4U);
    EXPECT_EQ(listed(EyeLayout::TopBottom), 4U);
    EXPECT_EQ(capabilities(), 10);
    kernel.fail(kernel.calls().size() + 5, EINVAL); // open, resources, two capabilities, this one
    EXPECT_EQ(listed(EyeLayout::SideBySide), 1U) << "an older kernel";
}

std::ptrdiff_t threads_now() {
    return std::distance(fs::directory_iterator("/proc/self/task"), fs::directory_iterator());
}

TEST_F(KmsCardTest, OnlyEyesInTurnHaveAThread) {
    const Result<KmsCard> card = KmsCard::open(card_path, {});
    ASSERT_TRUE(card) << card.error().message;
    const std::ptrdiff_t before = threads_now();
    for (const EyeLayout eyes : {EyeLayout::One, EyeLayout::SideBySide, EyeLayout::TopBottom}) {
        const std::unique_ptr<KmsDevice> device = make_device(*card, eyes);
        ASSERT_TRUE(device) << static_cast<int>(eyes);
        EXPECT_FALSE(device->alive_until()) << static_cast<int>(eyes);
        EXPECT_EQ(threads_now(), before) << static_cast<int>(eyes);
    }
    std::unique_ptr<KmsDevice> device = make_device(*card, EyeLayout::InTurn);
    ASSERT_TRUE(device);
    EXPECT_TRUE(device->alive_until());
    EXPECT_EQ(threads_now(), before + 1);
    device.reset();
    EXPECT_EQ(threads_now(), before) << "it ends with its device";
}

TEST_F(KmsCardTest, ReportsACardWithoutAtomicCommits) {
    desk.card.atomic = false;
    EXPECT_FALSE(KmsCard::open(card_path, {})->is_atomic());
    desk.card.atomic = true;
    desk.card.universal_planes = false;
    EXPECT_FALSE(KmsCard::open(card_path, {})->is_atomic());
}

TEST_F(KmsCardTest, ReportsWhyACardCannotBeOpened) {
    for (const int error : {EACCES, EPERM}) {
        kernel.fail_always("open", error);
        const Result<KmsCard> refused = KmsCard::open("fake0", {});
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().kind, ErrorKind::BadConfiguration);
        EXPECT_TRUE(holds(refused.error().message, "/dev/dri/fake0 cannot be opened"))
            << refused.error().message;
        EXPECT_TRUE(holds(refused.error().message, "group video")) << refused.error().message;
    }
    kernel.fail_always("open", 0);
    desk.card.gone = true;
    const Result<KmsCard> gone = KmsCard::open("fake0", {});
    ASSERT_FALSE(gone);
    EXPECT_EQ(gone.error().kind, ErrorKind::DeviceLost);
    EXPECT_TRUE(holds(gone.error().message, "No such device")) << gone.error().message;
    EXPECT_TRUE(holds(gone.error().message, "is its driver loaded")) << gone.error().message;
    kernel.add_card("/dev/dri/blind").add_crtc();
    const Result<KmsCard> blind = KmsCard::open("blind", {});
    ASSERT_FALSE(blind);
    EXPECT_EQ(blind.error().kind, ErrorKind::DeviceLost);
    EXPECT_TRUE(holds(blind.error().message, "/dev/dri/blind has no connectors")) << blind.error().message;
}

TEST_F(KmsCardTest, TheFirstFileThatIsOpenedHoldsTheScreen) {
    const Result<KmsCard> first = KmsCard::open(card_path, {});
    const Result<KmsCard> second = KmsCard::open(card_path, {});
    ASSERT_TRUE(first && second);
    EXPECT_TRUE(take_screen(first->file()));
    EXPECT_FALSE(take_screen(second->file()));
    EXPECT_FALSE(make_kms_device(*second)->become_master());
    EXPECT_TRUE(make_kms_device(*first)->become_master());
}

TEST_F(KmsCardTest, ARemovedCardIsBackWhenItCanBeOpened) {
    const Result<KmsCard> card = KmsCard::open(card_path, {});
    ASSERT_TRUE(card);
    desk.card.gone = true;
    EXPECT_EQ(card->look(true).state, CardState::Gone);
    EXPECT_EQ(look_for_projector(*card, nullptr, {}, true).state, CardState::Gone);
    desk.card.gone = false;
    kernel.fail(kernel.calls().size() + 1, ENODEV); // the file still belongs to the removed device
    EXPECT_EQ(card->look(true).state, CardState::Back);
}

TEST_F(KmsCardTest, IsMovable) {
    KmsCard card = KmsCard::open(card_path, {}).value();
    kernel.add_card("/dev/dri/fake1").add_crtc();
    kernel.card_at("/dev/dri/fake1")->add_connector(DRM_MODE_CONNECTOR_VGA, 1, {});
    KmsCard other = KmsCard::open("fake1", {}).value();
    const int file = card.file();
    other = std::move(card);
    EXPECT_EQ(other.file(), file);
    EXPECT_EQ(other.path(), card_path);
}

/// A folder of cards like /dev/dri, and a folder of their connectors like /sys/class/drm.
class SeveralCards : public WithTemporaryFolder {
protected:
    void SetUp() override { put("dri/renderD128", ""); }
    ~SeveralCards() override {
        EXPECT_EQ(kernel_.alive(), "");
        EXPECT_EQ(kernel_.wrongs(), "");
    }
    [[nodiscard]] std::string cards() const { return folder / "dri"; }
    [[nodiscard]] std::string path(const std::string& name) const { return folder / "dri" / name; }
    [[nodiscard]] std::string connectors() const { return folder / "sys"; }

    CardOnDesk& add(const std::string& name) {
        std::ofstream(path(name)).flush();
        desks_.push_back(std::make_unique<CardOnDesk>(kernel_.add_card(path(name))));
        return *desks_.back();
    }
    /// Sets a connector's status in sysfs.
    void say(const std::string& connector, const std::string& status) {
        fs::create_directories(folder / "sys" / connector);
        std::ofstream(folder / "sys" / connector / "status") << status << "\n";
    }
    [[nodiscard]] std::string opened(const OutputRequest& request = {}) const {
        const Result<KmsCard> card = KmsCard::open("", request, cards());
        return card ? fs::path(card->path()).filename().string() : card.error().message;
    }

    FakeKernel kernel_;
    std::vector<std::unique_ptr<CardOnDesk>> desks_;

private:
};

TEST_F(SeveralCards, ReportsThatThereIsNoCard) {
    EXPECT_TRUE(holds(opened(), "no graphics card in " + cards())) << opened();
    EXPECT_TRUE(holds(KmsCard::open("", {}, cards() + "/none").error().message, "no graphics card"));
}

TEST_F(SeveralCards, OpensTheCardWithTheProjector) {
    CardOnDesk& first = add("card0");
    EXPECT_EQ(opened(), "card0");
    CardOnDesk& second = add("card1");
    EXPECT_EQ(opened(), "card0") << "among equals the first";
    first.card.unplug(first.hdmi);
    EXPECT_EQ(opened(), "card1");
    second.card.unplug(second.hdmi);
    EXPECT_EQ(opened(), "card0") << "none is certain to have one";
    second.card.plug(second.other, projector_modes());
    first.card.plug(first.hdmi, projector_modes());
    EXPECT_EQ(opened(asks_for("DP-1")), "card1");
    EXPECT_EQ(KmsCard::open("card1", {}, cards())->path(), path("card1")) << "the one that is named";
}

TEST_F(SeveralCards, SkipsACardThatCannotBeOpenedElseReportsWhy) {
    add("card0").card.gone = true;
    add("card1");
    EXPECT_EQ(opened(), "card1");
    kernel_.fail_always("open", EACCES);
    EXPECT_TRUE(holds(opened(), "card0 cannot be opened: Permission denied")) << opened();
}

TEST_F(SeveralCards, ARemovedCardMayReturnUnderAnotherName) {
    add("card0");
    const Result<KmsCard> card = KmsCard::open("", {}, cards());
    ASSERT_TRUE(card);
    desks_[0]->card.gone = true;
    EXPECT_EQ(card->look(true).state, CardState::Gone);
    add("card1");
    EXPECT_EQ(card->look(true).state, CardState::Back);
    const Result<KmsCard> named = KmsCard::open(path("card0"), {}, cards());
    EXPECT_FALSE(named) << "the one that is named is gone all the same";
}

TEST_F(SeveralCards, ReportsAProjectorElsewhereOnlyIfTheCardHasNone) {
    CardOnDesk& own = add("card0");
    CardOnDesk& second = add("card1");
    own.card.unplug(own.hdmi);
    second.card.unplug(second.hdmi);
    const Result<KmsCard> card = KmsCard::open(path("card0"), {}, cards());
    ASSERT_TRUE(card);
    OtherCards others(path("card0"), {}, connectors());
    const auto state = [&] { return look_for_projector(*card, &others, {}, true).state; };
    EXPECT_EQ(state(), CardState::There);
    say("card0-HDMI-A-1", "connected");
    EXPECT_EQ(state(), CardState::There) << "its own";
    second.card.plug(second.hdmi, projector_modes());
    say("card1-HDMI-A-1", "connected");
    EXPECT_EQ(state(), CardState::Elsewhere);
    EXPECT_EQ(look_for_projector(*card, nullptr, {}, true).state, CardState::There)
        << "this card was asked for";
    own.card.plug(own.hdmi, projector_modes());
    EXPECT_EQ(state(), CardState::There);
}

TEST_F(SeveralCards, ReopensAnotherCardOnlyWhenItsConnectorsChange) {
    add("card0");
    CardOnDesk& second = add("card1");
    second.card.plug(second.hdmi, {}); // connected, but without a mode
    say("card1-HDMI-A-1", "connected");
    OtherCards others(path("card0"), {}, connectors());
    const auto opens = [&] {
        const std::size_t before = kernel_.calls().size();
        EXPECT_FALSE(others.have_projector());
        return std::count(kernel_.calls().begin() + static_cast<std::ptrdiff_t>(before),
                          kernel_.calls().end(), "open");
    };
    kernel_.fail_always("open", EACCES);
    EXPECT_EQ(opens(), 1);
    kernel_.fail_always("open", 0);
    EXPECT_EQ(opens(), 1) << "it could not be opened before";
    EXPECT_EQ(opens(), 0);
    say("card1-DP-1", "connected");
    EXPECT_EQ(opens(), 1);
    OtherCards named(path("card0"), asks_for("VGA-1"), connectors());
    EXPECT_FALSE(named.have_projector());
}

} // namespace
} // namespace frustumscreen::display
