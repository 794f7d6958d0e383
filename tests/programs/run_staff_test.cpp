// The staff's picture, over an exhibit that only keeps a record of what it was asked.

#include "app/programs/run_staff.h"
#include "app/render/read_back.h"
#include "firmware_host/display/surfaceless_display.h"

#include <gtest/gtest.h>

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
    DrawResult frame() {
        const DrawResult drawn =
            show->draw(now, {}, {display->framebuffer(), display->buffer_age()}, Redraw::Changes);
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

} // namespace
} // namespace frustumscreen
