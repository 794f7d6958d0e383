// The staff's picture, over an exhibit that only keeps a record of what it was asked.

#include "app/exhibit/attract.h"
#include "app/render/read_back.h"
#include "app/show/staff_show.h"
#include "firmware_host/display/surfaceless_display.h"
#include "firmware_host/panel/buttons.h"
#include "tests/exhibit/flash_counter.h"

#include <GLES3/gl31.h>
#include <gtest/gtest.h>

#include <random>

namespace frustumscreen {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const MonotonicTime start{seconds(100)};

struct Record {
    std::vector<int> ages; ///< of the buffers it was given
    std::vector<Wish> wishes;
    std::vector<Wish> taken_back;
    int took = 0;
};

class RecordingShow final : public Show {
public:
    explicit RecordingShow(Record& record) : record_(record) {}
    void wish(Wish wish, MonotonicTime) override { record_.wishes.push_back(wish); }
    void take_back(Wish wish, MonotonicTime) override { record_.taken_back.push_back(wish); }
    [[nodiscard]] bool heeds(Wish wish) const override { return wish == Wish::NextArtifact; }
    [[nodiscard]] DrawResult draw(MonotonicTime, const Situation&, const RenderTarget& target,
                                  Redraw) override {
        record_.ages.push_back(target.buffer_age);
        return {true, {}, {}, 1};
    }
    void took(MonotonicTime, double) override { ++record_.took; }
    [[nodiscard]] ShowState state(MonotonicTime) const override { return {"Cat", "en", {}, true}; }

private:
    Record& record_;
};

class RunStaff : public ::testing::Test {
protected:
    void SetUp() override {
        settings.panel.kind = PanelKind::Gpio;
        settings.panel.lines = {"4", "5", "6"};
        settings.projector.pinhole = {320, 200, 480.0, 480.0, 160.0, 100.0};
        auto made = SurfacelessDisplay::create(320, 200);
        ASSERT_TRUE(made) << made.error().message;
        display = std::move(*made);
        show = std::make_unique<StaffShow>(settings, std::make_unique<RecordingShow>(record), "a driver");
        status.tracker = Sentence("the tracker is running");
        frame();
        frame();
    }
    DrawResult frame(const Situation& situation = {}) {
        const DrawResult drawn =
            show->draw(now, situation, {display->framebuffer(), display->buffer_age()}, Redraw::Changes);
        show->took(now, 1.0);
        if (drawn.drawn) {
            EXPECT_TRUE(display->present(now));
        }
        now += milliseconds(16);
        return drawn;
    }
    /// The pattern's outermost pixels are white.
    [[nodiscard]] bool pattern_is_on() const {
        const Image8 picture = read_colour(display->framebuffer(), 320, 200);
        return picture.at(0, 100).r == 255 && picture.at(319, 199).r == 255;
    }

    Settings settings;
    Record record;
    RunStatus status;
    std::unique_ptr<SurfacelessDisplay> display;
    std::unique_ptr<StaffShow> show;
    MonotonicTime now = start;
};

TEST_F(RunStaff, TheChordBringsThePatternAndAPressEndsItAndMeansNothingElse) {
    EXPECT_FALSE(pattern_is_on());
    show->chord(now, status);
    frame();
    EXPECT_TRUE(pattern_is_on());
    EXPECT_EQ(record.ages, (std::vector<int>{0, 1}));
    EXPECT_EQ(record.took, 2); // the pattern's time is none of the governor's
    show->wish(Wish::NextArtifact, now);
    EXPECT_TRUE(record.wishes.empty());
    frame();
    frame();
    EXPECT_EQ(record.ages, (std::vector<int>{0, 1, 0, 1})); // at first the buffer holds nothing of its own
    show->wish(Wish::NextArtifact, now);
    EXPECT_EQ(record.wishes.size(), 1U);
    EXPECT_TRUE(show->heeds(Wish::NextArtifact));
    EXPECT_FALSE(show->heeds(Wish::NextLanguage));
}

TEST_F(RunStaff, TheChordTakesBackItsOwnPressesAndNoOthers) {
    show->chord(now, status); // a panel that says no presses
    EXPECT_TRUE(record.taken_back.empty());
    show->chord(now, status);

    const std::vector<Wish> first_and_last{Wish::PreviousArtifact, Wish::NextLanguage};
    for (const Wish wish :
         {Wish::NextArtifact, Wish::PreviousArtifact, Wish::NextLanguage, Wish::NextArtifact}) {
        show->wish(wish, now);
    }
    show->chord(now, status);
    EXPECT_EQ(record.wishes.size(), 4U) << "each at once";
    EXPECT_EQ(record.taken_back, first_and_last);

    show->wish(Wish::PreviousArtifact, now); // ends the pattern and means nothing else
    show->wish(Wish::NextLanguage, now);
    show->chord(now, status);
    EXPECT_EQ(record.wishes.size(), 5U);
    ASSERT_EQ(record.taken_back.size(), 3U);
    EXPECT_EQ(record.taken_back.back(), Wish::NextLanguage);
}

TEST_F(RunStaff, OfTwoButtonsTheChordTakesBackPreviousAndNext) {
    settings.panel.lines = {"4", "5"};
    show->wish(Wish::PreviousArtifact, now);
    show->wish(Wish::NextArtifact, now);
    show->chord(now, status);
    EXPECT_EQ(record.taken_back, (std::vector<Wish>{Wish::PreviousArtifact, Wish::NextArtifact}));
}

TEST_F(RunStaff, EndsByItselfAfterAMinuteOrByTheChord) {
    show->chord(now, status);
    const MonotonicTime end = now + StaffShow::length;
    frame();
    now = end - milliseconds(1);
    frame();
    EXPECT_EQ(record.ages.size(), 2U);
    frame(); // past it
    EXPECT_EQ(record.ages.size(), 3U);
    show->chord(now, status);
    frame();
    show->chord(now, status);
    frame();
    EXPECT_EQ(record.ages, (std::vector<int>{0, 1, 0, 0}));
}

TEST_F(RunStaff, SaysTheDevicesStatesAndRedrawsOnlyWhenTheyChange) {
    show->chord(now, status);
    frame();
    const Image8 before = read_colour(display->framebuffer(), 320, 200);
    show->tell(status);
    EXPECT_FALSE(frame().drawn);
    status.tracker = Sentence("no tracker is connected; check its USB cable and its power");
    show->tell(status);
    EXPECT_TRUE(frame().drawn);
    EXPECT_NE(read_colour(display->framebuffer(), 320, 200).texels, before.texels);
}

/// An exhibit whose artifacts are as white as can be, everywhere.
class WhiteShow final : public Show {
public:
    void wish(Wish wish, MonotonicTime now) override { exhibit_.wish(wish, now); }
    void take_back(Wish wish, MonotonicTime now) override { exhibit_.take_back(wish, now); }
    [[nodiscard]] DrawResult draw(MonotonicTime now, const Situation& situation, const RenderTarget& target,
                                  Redraw) override {
        const Stand stand = attract_.at(now, situation.prop_known, situation.prop_age, {});
        const auto brightness = static_cast<float>(exhibit_.at(now).brightness * stand.brightness);
        glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
        glDisable(GL_SCISSOR_TEST);
        glClearColor(brightness, brightness, brightness, 1.0F);
        glClear(GL_COLOR_BUFFER_BIT);
        const PixelRectangle whole{0, 0, 320, 200};
        return {true, whole, whole, 1};
    }
    [[nodiscard]] ShowState state(MonotonicTime) const override { return {"White", "en", {}, true}; }

private:
    Exhibit exhibit_{3, {"en", "de"}, "en", start};
    Attract attract_{{0.0, 0.0}, true, start};
};

/// WCAG 2.2's relative luminance of an sRGB colour.
double luminance_of(const glm::u8vec4& colour) {
    const auto linear = [](std::uint8_t code) {
        const double c = code / 255.0;
        return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(colour.r) + 0.7152 * linear(colour.g) + 0.0722 * linear(colour.b);
}

/// Fingers on all buttons, mostly after the chord and then the quickest press there is; what the pixels show.
TEST_F(RunStaff, NoPixelFlashesMoreThanThreeTimesASecondWhateverIsPressed) {
    int most = 0;
    int patterns = 0;
    for (unsigned seed = 0; seed < 8; ++seed) {
        std::mt19937 random(seed);
        show = std::make_unique<StaffShow>(settings, std::make_unique<WhiteShow>(), "a driver");
        now = start;
        ButtonTimes times;
        times.chatter_window = seed % 2 == 0 ? times.chatter_window : Nanoseconds(0); // 0: none is ignored
        Buttons buttons(3, times);
        std::array<bool, 3> levels{};
        std::vector<PanelEvent> events;
        MonotonicTime chord_until = start;
        std::optional<MonotonicTime> lost; // in half of the runs the prop comes and goes, too
        MonotonicTime prop_turns = start;
        std::array<std::vector<Luminance>, 40> places; // spread over the picture and on its border
        while (now < start + seconds(40)) {
            if (now >= chord_until + seconds(1)) {
                chord_until = now + milliseconds(3000 + random() % 200);
            }
            const bool chord = now < chord_until;
            levels = {chord || random() % 2 == 0, random() % 2 == 0, chord || random() % 2 == 0};
            events.clear();
            buttons.sample(now, levels, events);
            for (const PanelEvent& event : events) { // as the run's loop does
                if (event.kind == PressKind::Chord) {
                    show->chord(now, status);
                    ++patterns;
                } else if (event.kind == PressKind::Press) {
                    show->wish(static_cast<Wish>(event.button), now);
                }
            }
            if (now >= prop_turns) {
                lost = lost || seed % 4 < 2 ? std::nullopt : std::optional(now);
                prop_turns += milliseconds(lost ? 2000 + random() % 1300 : random() % 500);
            }
            const MonotonicTime shown = now;
            Situation situation;
            situation.prop_known = !lost;
            situation.prop_age = lost ? now - *lost : Nanoseconds(0);
            frame(situation);
            const Image8 picture = read_colour(display->framebuffer(), 320, 200);
            for (std::size_t k = 0; k < places.size(); ++k) {
                const int x = k % 8 == 0 ? 0 : static_cast<int>(k % 8) * 44;
                places[k].push_back({shown, luminance_of(picture.at(x, 10 + 40 * static_cast<int>(k / 8)))});
            }
        }
        for (const std::vector<Luminance>& place : places) {
            most = std::max(most, most_flashes_a_second(place));
        }
    }
    EXPECT_GT(patterns, 30);
    EXPECT_GE(most, 2) << "nothing was seen of the presses";
    EXPECT_LE(most, 3);
}

} // namespace
} // namespace frustumscreen
