// Two eyes' pictures in turn, from the presenter to the fake card's scanout.
#include "tests/display/eyes_at_desk.h"

namespace frustumscreen::display {
namespace {

class EyeOrderTest : public Desk {
protected:
    EyeOrderTest() { desk.card.plug(desk.hdmi, fast_modes()); }
};

TEST_F(EyeOrderTest, EachRefreshShowsTheEyeOfItsParity) {
    for (const std::uint32_t begin : {0U, 1U, 0xFFFFFFC0U}) { // the kernel's number in an event has 32 bits
        desk.card.refreshes = begin;
        Sitting sitting(desk, 1);
        sitting.frames(5);
        EXPECT_TRUE(sitting.in_order());
        EXPECT_EQ(sitting.eyes().wrongs, "");
        EXPECT_EQ(sitting.eyes().by_card, 0);
        EXPECT_EQ(sitting.state(),
                  "the projector at HDMI-A-1 is lit, 320 x 200 at 120 Hz; each eye gets 60 Hz");
        EXPECT_EQ(sitting.condition().health, DeviceHealth::Well);
        EXPECT_GE(sitting.eyes().newest + 2, sitting.clock().drawn) << "the newest picture is shown";
    }
    EXPECT_EQ(desk.card.removed_while_shown(), 3) << "at the end of each";
}

TEST_F(EyeOrderTest, AlternatesWhileNothingNewIsDrawn) {
    Sitting sitting(desk, 2);
    sitting.frames(5);
    const int before = sitting.eyes().kept;
    const std::uint32_t began = desk.card.refreshes;
    sitting.rest(std::chrono::seconds(10));
    EXPECT_EQ(sitting.eyes().kept - before, static_cast<int>(desk.card.refreshes - began));
    EXPECT_GE(sitting.eyes().kept - before, 1199);
    EXPECT_EQ(sitting.eyes().wrongs, "");
    EXPECT_TRUE(sitting.in_order());
}

TEST_F(EyeOrderTest, AlternatesDuringASlowFrame) {
    Sitting sitting(desk, 3);
    sitting.frames(5);
    const int before = sitting.eyes().repeated;
    for (int k = 1; k < 60; ++k) {
        sitting.frame(std::chrono::milliseconds(3 * k));
    }
    EXPECT_EQ(sitting.eyes().repeated, before);
    EXPECT_EQ(sitting.eyes().wrongs, "");
}

TEST_F(EyeOrderTest, ShowsThePictureAtThePredictedTime) {
    Sitting sitting(desk, 4);
    sitting.frames(20);
    for (int k = 0; k < 50; ++k) {
        const MonotonicTime told = sitting.frame();
        ASSERT_EQ(sitting.eyes().newest, sitting.clock().drawn) << "the next frame begins with its light";
        EXPECT_LT(std::chrono::abs(told - sitting.eyes().newest_at), std::chrono::microseconds(200));
    }
}

TEST_F(EyeOrderTest, LateWakeUpsRepeatRefreshesButKeepTheOrder) {
    for (unsigned seed = 0; seed < 40; ++seed) {
        Sitting sitting(desk, seed);
        sitting.frames(5);
        sitting.slow_wakes = 20;
        sitting.frames(100);
        EXPECT_GT(sitting.eyes().repeated, 20) << "the test has an effect";
        EXPECT_EQ(sitting.eyes().by_card, 0);
        EXPECT_EQ(sitting.eyes().wrongs, "") << seed;
        sitting.slow_wakes = 0;
        EXPECT_TRUE(sitting.in_order()) << seed;
    }
}

TEST_F(EyeOrderTest, RestoresTheOrderAfterALateFlip) {
    Sitting sitting(desk, 5);
    sitting.frames(5);
    for (const int late : {1, 2, 3, 5}) {
        const int by_card = sitting.eyes().by_card;
        desk.card.late = late;
        sitting.frames(6);
        EXPECT_EQ(sitting.eyes().by_card, by_card + 1);
        EXPECT_TRUE(sitting.in_order()) << late;
    }
    EXPECT_EQ(sitting.eyes().wrongs, "");
}

TEST_F(EyeOrderTest, RecoversQuicklyFromALostFlipReport) {
    Sitting sitting(desk, 6);
    sitting.frames(5);
    for (const int lost : {1, 2, 4}) {
        const int repeated = sitting.eyes().repeated;
        desk.card.lost = lost;
        sitting.frames(40);
        EXPECT_LT(sitting.eyes().repeated - repeated, 14 * lost);
        EXPECT_TRUE(sitting.in_order()) << lost;
        EXPECT_TRUE(has_words(sitting.state(), "is lit")) << sitting.state();
    }
    EXPECT_EQ(sitting.eyes().wrongs, "");
}

TEST_F(EyeOrderTest, WaitsForALatePictureEvenIfTheNextFlipFails) {
    Sitting sitting(desk, 11);
    sitting.frames(5);
    sitting.frame(std::chrono::milliseconds(15));
    desk.card.late = 30;
    sitting.rest(std::chrono::milliseconds(1)); // the card takes the picture
    kernel.fail_always("drmModeAtomicCommit", EINVAL);
    sitting.frames(3);
    EXPECT_EQ(sitting.eyes().by_card, 1) << "the test has an effect";
    EXPECT_EQ(sitting.condition().id, "display.picture_refused");
    kernel.fail_always("drmModeAtomicCommit", 0);
    sitting.frames(100);
    EXPECT_TRUE(sitting.in_order());
    EXPECT_EQ(sitting.eyes().wrongs, "");
}

TEST_F(EyeOrderTest, KeepsTheOrderOverSleepAndWake) {
    Sitting sitting(desk, 7);
    sitting.frames(5);
    for (int k = 0; k < 4; ++k) {
        sitting.sleep(20);
        EXPECT_FALSE(desk.card.shown(desk.hdmi));
        EXPECT_EQ(sitting.condition().id, "display.asleep");
        sitting.frames(5);
        EXPECT_TRUE(sitting.in_order());
        sitting.sleep(1); // the flip for the next refresh is not done: it stays lit
        EXPECT_TRUE(sitting.in_order());
    }
    EXPECT_EQ(sitting.eyes().wrongs, "");
}

/// The projector is unplugged and plugged again, and nothing fails any more.
void expect_order_after_plugging(CardOnDesk& desk, Sitting& sitting) {
    desk.card.unplug(desk.hdmi);
    sitting.plugged();
    sitting.frames(100);
    desk.card.plug(desk.hdmi, fast_modes());
    sitting.plugged();
    sitting.frames(100);
    ASSERT_EQ(sitting.end(), "");
    EXPECT_TRUE(sitting.in_order()) << sitting.state();
    EXPECT_EQ(sitting.eyes().wrongs, "");
    EXPECT_TRUE(has_words(sitting.state(), "each eye gets 60 Hz")) << sitting.state();
}

TEST_F(EyeOrderTest, RestoresTheOrderAfterRandomFaults) {
    int refreshes = 0;
    int starts = 0;
    for (unsigned seed = 0; seed < 60; ++seed) {
        FakeKernel own;
        CardOnDesk other(own.add_card(card_path));
        other.card.plug(other.hdmi, fast_modes());
        other.card.refreshes = seed;
        std::mt19937 random(seed);
        const auto one_of = [&random](unsigned count) { return static_cast<int>(random() % count); };
        std::optional<Sitting> evening(std::in_place, other, seed);
        Sitting& sitting = *evening;
        for (int step = 0; step < 25; ++step) {
            const int error =
                std::array{EBUSY, EINVAL, EACCES, ENOMEM}.at(static_cast<std::size_t>(one_of(4)));
            switch (one_of(9)) {
            case 0:
                other.card.late = one_of(40);
                break;
            case 1:
                other.card.lost = one_of(3);
                break;
            case 2:
                sitting.slow_wakes = one_of(30);
                break;
            case 3:
                own.fail_always("drmModeAtomicCommit", one_of(2) == 0 ? error : 0);
                break;
            case 4:
                own.fail(own.calls().size() + static_cast<std::size_t>(one_of(50)), error);
                break;
            case 5:
                other.card.unplug(other.hdmi);
                sitting.plugged();
                break;
            case 6:
                other.card.plug(other.hdmi, {fast_modes()[static_cast<std::size_t>(one_of(3))]});
                sitting.plugged();
                break;
            case 7:
                sitting.sleep(one_of(5));
                break;
            default:
                sitting.rest(std::chrono::milliseconds(one_of(300)));
                break;
            }
            sitting.frames(one_of(20));
        }
        EXPECT_EQ(sitting.eyes().wrongs, "") << seed;
        other.card.late = other.card.lost = sitting.slow_wakes = 0;
        own.fail_always("drmModeAtomicCommit", 0);
        own.fail(0, 0);
        if (!sitting.end().empty()) { // the program is started again
            EXPECT_TRUE(has_words(sitting.end(), "display: ")) << sitting.end();
            evening.reset();
            evening.emplace(other, seed);
            ++starts;
        }
        expect_order_after_plugging(other, *evening);
        refreshes += evening->eyes().kept;
    }
    EXPECT_LT(starts, 30) << "most histories need no new start";
    EXPECT_GT(refreshes, 20'000);
}

/// If any one call fails once, the eyes are in order in the end, or a sentence says why they cannot be or why the program
/// must end.
TEST_F(EyeOrderTest, RecoversFromOrReportsAnySingleFailedCall) {
    struct Outcome {
        std::vector<std::string> calls;
        std::string wrongs;
    };
    const auto once = [](std::size_t call, int error, bool one_eye_will_do) {
        FakeKernel own;
        CardOnDesk other(own.add_card(card_path));
        other.card.plug(other.hdmi, fast_modes());
        own.fail(call, error);
        Outcome outcome;
        {
            Sitting sitting(other, 1);
            sitting.frames(4);
            sitting.sleep(6);
            sitting.frames(3);
            outcome.calls = own.calls();
            sitting.frame(); // the state tells of a failed call with the next picture
            const auto says = [&sitting](std::string_view words) {
                return has_words(sitting.state(), words);
            };
            for (int k = 0; k < 20 && sitting.end().empty() && !says("each eye gets 60 Hz"); ++k) {
                sitting.frames(10);
            }
            const bool one_eye =
                sitting.end().empty() && one_eye_will_do && says("cannot show the eyes in turn");
            if (sitting.end().empty() && !one_eye && !sitting.in_order(20)) {
                outcome.wrongs += "not in order: " + std::string(sitting.state()) + "; ";
            }
            if (!sitting.end().empty() && !has_words(sitting.end(), "display: ")) {
                outcome.wrongs += "ends with " + sitting.end() + "; ";
            }
            outcome.wrongs += sitting.is_open() ? sitting.eyes().wrongs : "";
        }
        outcome.wrongs += own.alive() + own.wrongs();
        return outcome;
    };
    const Outcome undisturbed = once(0, 0, false);
    ASSERT_EQ(undisturbed.wrongs, "");
    std::size_t runs = 0;
    for (std::size_t k = 1; k <= undisturbed.calls.size(); ++k) {
        const std::string& call = undisturbed.calls[k - 1];
        const bool commits = call == "drmModeAtomicCommit";
        std::vector<int> errors = FakeKernel::errors_of(call);
        if (!commits) {
            errors = {errors[k % errors.size()]}; // the kms_evening_test has them all
        }
        for (const int error : errors) {
            EXPECT_EQ(once(k, error, !commits).wrongs, "") << "call " << k << ", " << call << ": " << error;
            ++runs;
        }
    }
    EXPECT_GT(runs, undisturbed.calls.size());
}

TEST_F(EyeOrderTest, ShowsTheLeftEyeIfTheCardCannotAlternate) {
    const auto expect_the_left_eye = [this](const std::string& why) {
        Sitting sitting(desk, 8);
        sitting.frames(20);
        ASSERT_TRUE(desk.card.shown(desk.hdmi)) << why;
        EXPECT_EQ(desk.card.scanned(desk.hdmi)->first_row, 0U) << why;
        EXPECT_GE(sitting.eyes().newest + 1, sitting.clock().drawn) << why << ": new pictures are shown";
        EXPECT_TRUE(
            has_words(sitting.state(), "/dev/dri/fake0 cannot show the eyes in turn, so the left eye's"))
            << sitting.state();
        EXPECT_EQ(sitting.condition().health, DeviceHealth::Impaired);
        EXPECT_EQ(sitting.condition().id, "display.one_eye");
    };
    desk.card.fixed = {"SRC_Y"};
    expect_the_left_eye("its driver shows other rows only in another mode");
    desk.card.fixed = {};
    desk.card.vertical_blanks = false;
    expect_the_left_eye("its driver counts no refreshes");
    desk.card.vertical_blanks = true;
    desk.card.monotonic = false;
    expect_the_left_eye("its refreshes have another clock");
}

TEST_F(EyeOrderTest, ShowsTheUpperHalfWithoutAtomicCommits) {
    desk.card.atomic = false;
    desk.card.flips_at_once = false;
    const OutputRequest request = wish_for_turns();
    const KmsCard card = KmsCard::open(card_path, request).value();
    const std::unique_ptr<KmsDevice> kms = make_kms_device(card);
    OnTestClock clock(*kms);
    const std::uint32_t drawn = 7;
    Presenter presenter(
        clock, [&](PixelSize size) { return StampedPair::make(card.file(), size, drawn); }, request);
    presenter.connected(card.look(true));
    for (int k = 0; k < 5; ++k) {
        ASSERT_TRUE(presenter.present({0, 0, 320, 400}, true));
        desk.card.refresh();
    }
    const auto shown = desk.card.shown(desk.hdmi);
    ASSERT_TRUE(shown);
    EXPECT_EQ(desk.card.height(shown->framebuffer), 400U) << "it holds both eyes' pictures";
    EXPECT_EQ(desk.card.value(desk.planes[0], "SRC_Y"), 0U);
    EXPECT_EQ(desk.card.value(desk.planes[0], "SRC_H") >> 16U, 200U);
    EXPECT_EQ(presenter.condition().id, "display.one_eye");
    EXPECT_TRUE(has_words(presenter.state(), "/dev/dri/fake0 cannot show")) << presenter.state();
}

TEST_F(EyeOrderTest, UsesASlowModeOnlyWithoutAFastOneAndReportsItsRate) {
    desk.card.plug(desk.hdmi, {kernel_mode(320, 200, 60.0, true)});
    Sitting sitting(desk, 9);
    sitting.frames(30);
    EXPECT_EQ(sitting.state(),
              "the projector at HDMI-A-1 is lit, 320 x 200 at 60 Hz; each eye gets 30 Hz, which "
              "flickers: set display.mode to one of at least 100 Hz");
    EXPECT_EQ(sitting.condition().health, DeviceHealth::Impaired);
    EXPECT_EQ(sitting.condition().id, "display.eyes_flicker");
    desk.card.unplug(desk.hdmi);
    sitting.plugged();
    sitting.frames(5);
    desk.card.plug(desk.hdmi, {kernel_mode(320, 200, 60.0, true), kernel_mode(256, 192, 120.0)});
    sitting.plugged();
    sitting.frames(5);
    EXPECT_EQ(desk.card.shown(desk.hdmi)->mode.hdisplay, 256) << "rather a smaller one";
    EXPECT_TRUE(sitting.in_order());
    EXPECT_EQ(sitting.eyes().wrongs, "");
}

TEST_F(EyeOrderTest, PlacesEachHalfInAModeOfAnotherSize) {
    desk.card.plug(desk.hdmi, {kernel_mode(256, 192, 120.0, true)});
    for (const bool scales : {true, false}) {
        desk.card.scales = scales;
        Sitting sitting(desk, 10);
        sitting.frames(5);
        EXPECT_TRUE(sitting.in_order());
        EXPECT_EQ(sitting.eyes().wrongs, "");
        const auto value = [this](const std::string& name) { return desk.card.value(desk.planes[0], name); };
        EXPECT_EQ(value("SRC_H") >> 16U, scales ? 200U : 192U);
        EXPECT_EQ(value("CRTC_H"), scales ? 160U : 192U) << "black above and below";
        EXPECT_EQ(desk.card.height(static_cast<std::uint32_t>(value("FB_ID"))), scales ? 400U : 384U);
    }
}

} // namespace
} // namespace frustumscreen::display
