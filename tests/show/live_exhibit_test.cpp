// The staff picture, over an exhibit that only records its calls.

#include "app/library/report_request.h"
#include "app/render/read_back.h"
#include "app/show/live_exhibit.h"
#include "firmware_host/base/file.h"
#include "firmware_host/display/surfaceless_display.h"
#include "firmware_host/panel/buttons.h"
#include "tests/base/temporary_folder.h"
#include "tests/exhibit/exhibits.h"
#include "tests/exhibit/flash_counter.h"

#include <GLES3/gl31.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace frustumscreen::show {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const MonotonicTime start{seconds(100)};

struct Record {
    std::vector<int> ages; ///< of the buffers passed in
    std::size_t eyes = 0;  ///< of the latest picture
    int times = 0;
};

/// Draws nothing, and records its calls.
class RecordingShow final : public PresentationShow {
public:
    explicit RecordingShow(Record& record) : record_(record) {}
    [[nodiscard]] render::DrawResult draw(MonotonicTime, const exhibit::Presentation&,
                                          std::span<const glm::dvec3> eyes_m,
                                          const render::RenderTarget& target, render::Redraw) override {
        record_.ages.push_back(target.buffer_age);
        record_.eyes = eyes_m.size();
        return {true, {}, {}, 1};
    }
    void record_time(MonotonicTime, double) override { ++record_.times; }
    [[nodiscard]] ShowState state(const exhibit::Presentation&) const override {
        return {"Cat", "en", {}, true};
    }

private:
    Record& record_;
};

constexpr std::array chord{settings::Command::StaffMode};
constexpr std::array next{settings::Command::NextArtifact};

class Live : public ::testing::Test {
protected:
    void SetUp() override {
        settings.panel.kind = settings::PanelKind::Gpio;
        settings.panel.lines = {"4", "5", "6"};
        settings.projector.pinhole = {320, 200, 480.0, 480.0, 160.0, 100.0};
        auto made = display::SurfacelessDisplay::create(320, 200);
        ASSERT_TRUE(made) << made.error().message;
        display = std::move(*made);
        show = std::make_unique<LiveExhibit>(settings, std::make_unique<RecordingShow>(record),
                                             sample::exhibit(3, {"en", "de"}), "a driver");
        status.tracker = Sentence("the tracker is running");
        frame();
        frame();
    }
    render::DrawResult frame(std::span<const settings::Command> commands = {},
                             const tracking::TrackedState& tracked_state = {}) {
        show->step(now, commands, tracked_state);
        if (std::find(commands.begin(), commands.end(), settings::Command::StaffMode) != commands.end()) {
            show->tell(status); // as the run loop does
        }
        const render::DrawResult drawn = show->draw(
            now, tracked_state, {display->framebuffer(), display->buffer_age()}, render::Redraw::Changes);
        show->record_time(now, 1.0);
        if (drawn.drawn) {
            EXPECT_TRUE(display->present(now));
        }
        now += milliseconds(16);
        return drawn;
    }
    [[nodiscard]] image::Image8 picture() const {
        return render::read_colour(display->framebuffer(), 320, 200);
    }
    /// True if the pattern's outermost pixels are white.
    [[nodiscard]] bool pattern_is_on() const {
        const image::Image8 now_shown = picture();
        return now_shown.at(0, 100).r == 255 && now_shown.at(319, 199).r == 255;
    }
    /// Presses the second button, and waits until the shown page has followed.
    void turn_page() {
        frame(next);
        now += exhibit::StaffTool::between_views;
        frame();
    }

    settings::Settings settings;
    Record record;
    RunStatus status;
    std::unique_ptr<display::SurfacelessDisplay> display;
    std::unique_ptr<LiveExhibit> show;
    MonotonicTime now = start;
};

TEST_F(Live, ChordOpensAndClosesTheStaffPicture) {
    frame(chord);
    EXPECT_EQ(record.ages, (std::vector<int>{0, 1}));
    EXPECT_EQ(record.times, 2); // the pattern's time does not reach the governor
    EXPECT_FALSE(pattern_is_on());
    turn_page();
    EXPECT_TRUE(pattern_is_on());
    EXPECT_EQ(record.ages.size(), 2U);
    frame(chord);
    frame();
    EXPECT_EQ(record.ages, (std::vector<int>{0, 1, 0, 1})); // at first the buffer holds no picture of its own
}

TEST_F(Live, DrawsTwoEyesOnlyInStereo) {
    EXPECT_EQ(record.eyes, 1U);
    settings.eye.stereo = settings::Stereo::Anaglyph;
    show = std::make_unique<LiveExhibit>(settings, std::make_unique<RecordingShow>(record),
                                         sample::exhibit(3, {"en"}), "a driver");
    frame();
    EXPECT_EQ(record.eyes, 2U);
}

/// Every page has its own picture; the white and black lights are exactly that, once their words have gone.
TEST_F(Live, EveryStaffPageHasItsOwnPicture) {
    frame(chord);
    std::vector<std::vector<glm::u8vec4>> seen{picture().texels};
    for (std::size_t page = 1; page < exhibit::staff_page_names.size(); ++page) {
        turn_page();
        seen.push_back(picture().texels);
        EXPECT_EQ(std::count(seen.begin(), seen.end(), seen.back()), 1) << exhibit::staff_page_names.at(page);
    }
    frame(chord);
    frame(chord);
    for (int page = 0; page < 3; ++page) {
        turn_page();
    }
    const auto all_are = [this](int code) {
        now += exhibit::StaffTool::words_stay;
        frame();
        const image::Image8 shown = picture();
        // The first row contains the watchdog's code.
        return std::all_of(shown.texels.begin() + shown.width, shown.texels.end(),
                           [code](const glm::u8vec4& texel) {
                               return texel.r == code && texel.g == code && texel.b == code;
                           });
    };
    EXPECT_FALSE(all_are(0));
    EXPECT_TRUE(all_are(255));
    frame(std::array{settings::Command::PreviousArtifact});
    EXPECT_TRUE(all_are(0));
    frame(std::array{settings::Command::PreviousArtifact});
    EXPECT_FALSE(all_are(0));
}

TEST_F(Live, PlacePageFollowsThePropAndTheStatusPageDoesNot) {
    frame(chord);
    tracking::TrackedState moved;
    moved.table_from_prop.translation.x = 0.1;
    EXPECT_FALSE(frame({}, moved).drawn) << "the status has no prop in it";
    turn_page();
    frame();
    EXPECT_FALSE(frame().drawn);
    EXPECT_TRUE(frame({}, moved).drawn);
}

TEST_F(Live, TrackerPageUpdatesAFewTimesASecond) {
    frame(chord);
    for (int page = 0; page < 5; ++page) {
        turn_page();
    }
    int drawn = 0;
    for (int k = 0; k < 120; ++k) { // two seconds
        show->set_signal({120.0 + k, 1.0, 0.01 * k, 0.001 * k}, {});
        drawn += frame().drawn ? 1 : 0;
    }
    EXPECT_GE(drawn, 5);
    EXPECT_LE(drawn, 8) << "once more as the pressed button goes out";
}

/// From the importer's report by the page's button to the run loop, and back.
TEST_F(Live, StaffButtonCopiesToAWaitingStickOnce) {
    const TemporaryFolder own;
    settings.exhibit.import_report = own.path() / "report.json";
    const auto tell = [&](const std::string& id, library::ImportStage stage,
                          const std::vector<library::ImportedPack>& lines) {
        library::ImportReport report;
        report.import_id = id;
        report.stage = stage;
        report.packs = lines;
        const std::string json = library::write_import_report(report);
        ASSERT_TRUE(write_file(settings.exhibit.import_report, as_bytes(json)));
    };
    show = std::make_unique<LiveExhibit>(settings, std::make_unique<RecordingShow>(record),
                                         sample::exhibit(3, {"en", "de"}), "a driver",
                                         residency::PromptReader::Answer::Always);
    status.copies = true;
    frame(chord);
    for (int page = 0; page < 6; ++page) {
        turn_page();
    }
    std::vector<std::vector<glm::u8vec4>> seen;
    const auto is_new = [&] {
        now += seconds(1);
        frame();
        now += seconds(1);
        frame();
        seen.push_back(picture().texels);
        return std::count(seen.begin(), seen.end(), seen.back()) == 1;
    };
    constexpr std::array held{settings::Command::HoldFirst};
    EXPECT_TRUE(is_new());
    frame(held);
    EXPECT_FALSE(show->state().copy) << "no stick waits";
    frame();
    tell("stick1", library::ImportStage::Found, {});
    EXPECT_TRUE(is_new());
    tell("stick1", library::ImportStage::Done, {library::copy_offer()});
    EXPECT_TRUE(is_new());
    frame(held);
    EXPECT_TRUE(show->state().copy);
    frame();
    EXPECT_FALSE(show->state().copy) << "once";
    EXPECT_TRUE(is_new());
    frame(held);
    EXPECT_FALSE(show->state().copy) << "it is being written";
    tell("stick1.staff", library::ImportStage::Done,
         {{.file = "frustumscreen-1a2b3c-2031",
           .title = "",
           .outcome = library::ImportOutcome::Written,
           .refusal = {},
           .reason = ""}});
    EXPECT_TRUE(is_new());
}

TEST_F(Live, StaffPictureEndsAfterAMinuteOrByTheChord) {
    const MonotonicTime end = now + exhibit::StaffTool::after_press;
    frame(chord);
    now = end - milliseconds(1);
    frame();
    EXPECT_EQ(record.ages.size(), 2U);
    frame(); // after it
    EXPECT_EQ(record.ages.size(), 3U);
    frame(chord);
    frame(chord);
    EXPECT_EQ(record.ages, (std::vector<int>{0, 1, 0, 0}));
}

TEST_F(Live, StatusPageRedrawsOnlyWhenADeviceStateChanges) {
    frame(chord);
    const image::Image8 before = render::read_colour(display->framebuffer(), 320, 200);
    show->tell(status);
    EXPECT_FALSE(frame().drawn);
    status.tracker = Sentence("no tracker is connected; check its USB cable and its power");
    show->tell(status);
    EXPECT_TRUE(frame().drawn);
    EXPECT_NE(render::read_colour(display->framebuffer(), 320, 200).texels, before.texels);
    status.sound = Sentence("the sound device default is not there");
    show->tell(status);
    EXPECT_TRUE(frame().drawn);
}

TEST_F(Live, StatusPageRedrawsWhenTheWatchdogReports) {
    frame(chord);
    status::Environment around;
    around.ends = watch::parse_service_ends("5 watchdog killed KILL\n");
    status.environment = std::make_shared<const status::Environment>(around);
    show->tell(status);
    EXPECT_TRUE(frame().drawn);
    around.watchdog.fields = {{"faults", {{{"at", "2026-05-01T10:00:00Z"}, {"sentence", "it is hot"}}}}};
    status.environment = std::make_shared<const status::Environment>(around);
    show->tell(status);
    EXPECT_TRUE(frame().drawn);
}

TEST_F(Live, StatusPageShowsThatUnsignedPacksAreAllowed) {
    frame(chord);
    const image::Image8 before = render::read_colour(display->framebuffer(), 320, 200);
    settings.exhibit.unsigned_packs = pack::UnsignedPacks::Allow;
    show->tell(status);
    EXPECT_TRUE(frame().drawn);
    EXPECT_NE(render::read_colour(display->framebuffer(), 320, 200).texels, before.texels);
}

/// A show whose artifacts are fully white everywhere.
class WhiteShow final : public PresentationShow {
public:
    [[nodiscard]] render::DrawResult draw(MonotonicTime, const exhibit::Presentation& presentation,
                                          std::span<const glm::dvec3>, const render::RenderTarget& target,
                                          render::Redraw) override {
        const auto brightness = static_cast<float>(presentation.brightness);
        glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
        glDisable(GL_SCISSOR_TEST);
        glClearColor(brightness, brightness, brightness, 1.0F);
        glClear(GL_COLOR_BUFFER_BIT);
        const PixelRectangle whole{0, 0, 320, 200};
        return {true, whole, whole, 1};
    }
    [[nodiscard]] ShowState state(const exhibit::Presentation&) const override {
        return {"White", "en", {}, true};
    }
};

/// WCAG 2.2's relative luminance of an sRGB colour.
double luminance_of(const glm::u8vec4& colour) {
    const auto linear = [](std::uint8_t code) {
        const double c = code / 255.0;
        return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(colour.r) + 0.7152 * linear(colour.g) + 0.0722 * linear(colour.b);
}

/// All buttons, mostly the fastest possible presses after the chord; the pixels are checked.
TEST_F(Live, NoPixelFlashesMoreThanThreeTimesASecond) {
    int most = 0;
    int patterns = 0;
    for (unsigned seed = 0; seed < 8; ++seed) {
        std::mt19937 random(seed);
        show = std::make_unique<LiveExhibit>(settings, std::make_unique<WhiteShow>(),
                                             sample::exhibit(3, {"en", "de"}), "a driver");
        now = start;
        panel::ButtonTimes times;
        times.chatter_window = seed % 2 == 0 ? times.chatter_window : Nanoseconds(0); // 0: off
        panel::Buttons buttons(3, times);
        std::array<bool, 3> levels{};
        std::vector<panel::PanelEvent> events;
        MonotonicTime chord_until = start;
        std::optional<MonotonicTime> lost; // in half of the runs the prop also comes and goes
        MonotonicTime prop_turns = start;
        std::array<std::vector<exhibit::Luminance>, 40> places; // spread over the picture and on its border
        while (now < start + seconds(40)) {
            if (now >= chord_until + seconds(1)) {
                chord_until = now + milliseconds(3000 + random() % 200);
            }
            const bool chord = now < chord_until;
            levels = {chord || random() % 2 == 0, random() % 2 == 0, chord || random() % 2 == 0};
            events.clear();
            buttons.sample(now, levels, events);
            std::vector<settings::Command> commands;
            for (const panel::PanelEvent& event : events) { // as the run loop does
                if (event.kind == panel::PressKind::Chord) {
                    commands.push_back(settings::Command::StaffMode);
                    ++patterns;
                } else if (event.kind == panel::PressKind::Press) {
                    commands.push_back(*settings::command_of_button(event.button));
                } else if (event.kind == panel::PressKind::LongPress) {
                    commands.push_back(event.button == 0 ? settings::Command::HoldFirst
                                                         : settings::Command::HoldOther);
                }
            }
            if (now >= prop_turns) {
                lost = lost || seed % 4 < 2 ? std::nullopt : std::optional(now);
                prop_turns += milliseconds(lost ? 2000 + random() % 1300 : random() % 500);
            }
            const MonotonicTime shown = now;
            tracking::TrackedState tracked_state;
            tracked_state.prop_known = !lost;
            tracked_state.prop_age = lost ? now - *lost : Nanoseconds(0);
            frame(commands, tracked_state);
            const image::Image8 picture = render::read_colour(display->framebuffer(), 320, 200);
            for (std::size_t k = 0; k < places.size(); ++k) {
                const int x = k % 8 == 0 ? 0 : static_cast<int>(k % 8) * 44;
                places[k].push_back({shown, luminance_of(picture.at(x, 10 + 40 * static_cast<int>(k / 8)))});
            }
        }
        for (const std::vector<exhibit::Luminance>& place : places) {
            most = std::max(most, exhibit::max_flashes_per_second(place));
        }
    }
    EXPECT_GT(patterns, 30);
    EXPECT_GE(most, 2) << "nothing was seen of the presses";
    EXPECT_LE(most, 3);
}

} // namespace
} // namespace frustumscreen::show
