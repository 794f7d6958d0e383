// The screen behind the table beside the projector: its pace, its faults, its sleep. No picture is drawn here.
#include "app/exhibit/states.h"
#include "app/show/run_loop.h"
#include "app/show/screen_output.h"
#include "tests/display/no_display.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace frustumscreen::show {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// The events of both displays, in order.
struct Log {
    std::vector<std::string> lines;
    [[nodiscard]] std::ptrdiff_t count(const std::string& line) const {
        return std::count(lines.begin(), lines.end(), line);
    }
};

class LoggedDisplay final : public display::Display {
public:
    LoggedDisplay(Log& log, std::string name) : log_(log), name_(std::move(name)) {}
    ~LoggedDisplay() override { log_.lines.push_back(name_ + " closed"); }
    [[nodiscard]] bool make_current() const override {
        log_.lines.push_back(name_ + " current");
        return true;
    }
    [[nodiscard]] int width() const override { return 64; }
    [[nodiscard]] int height() const override { return 40; }
    [[nodiscard]] unsigned framebuffer() const override { return 0; }
    [[nodiscard]] int buffer_age() const override { return 1; }
    [[nodiscard]] Result<MonotonicTime> present(MonotonicTime now) override {
        if (broken) {
            return fail(ErrorKind::DeviceLost, "test.broken", "the cable has melted");
        }
        log_.lines.push_back(name_ + " presents");
        ++presents;
        return now;
    }
    [[nodiscard]] bool takes_picture() override { return !busy; }
    [[nodiscard]] Result<void> stay_dark() override {
        log_.lines.push_back(name_ + " dark");
        return {};
    }
    /// The code of the presented picture, unless it is frozen.
    [[nodiscard]] bool read_shown(std::span<std::byte> rgba) const override {
        const auto code = static_cast<std::uint8_t>(frozen ? 7 : presents + 1);
        for (std::size_t k = 0; k < rgba.size(); ++k) {
            rgba[k] = std::byte{probe_grey(code, static_cast<int>(k / 4))};
        }
        return true;
    }
    [[nodiscard]] std::string name() const override { return name_; }
    [[nodiscard]] std::string_view state() const override { return state_; }
    [[nodiscard]] DeviceCondition condition() const override { return {DeviceHealth::Well, "display.lit"}; }

    std::string_view state_ = "the projector at DP-1 is lit";
    bool busy = false, broken = false, frozen = false;
    int presents = 0;

private:
    Log& log_;
    std::string name_;
};

settings::Settings with_screen() {
    settings::Settings settings;
    settings.screen.room = "room.toml";
    settings.screen.connector = "DP-1";
    settings.screen.width = 64;
    settings.screen.height = 36;
    return settings;
}

class Screen : public testing::Test {
protected:
    ScreenParts parts() {
        return {[this]() -> Result<std::unique_ptr<display::Display>> {
                    ++opened;
                    if (no_display) {
                        return fail(ErrorKind::DeviceLost, "screen.no_such_connector", "no connector");
                    }
                    auto made = std::make_unique<LoggedDisplay>(log, "screen");
                    display = made.get();
                    return made;
                },
                [this]() -> Result<DrawRoom> {
                    ++read;
                    if (no_room) {
                        return bad_input("room.no_file", "room.toml: there is no such file");
                    }
                    return [this](const RoomFrame& frame) {
                        log.lines.emplace_back("screen draws");
                        drawn_s = frame.seconds;
                        drawn_light = frame.light;
                        drawn_eyes_m.assign(frame.eyes_m.begin(), frame.eyes_m.end());
                        render::DrawResult result;
                        result.drawn = moves || frame.redraw == render::Redraw::Again;
                        result.redrawn = moves ? PixelRectangle{0, 0, 64, 36} : PixelRectangle{};
                        return result;
                    };
                }};
    }
    void make() { screen = std::make_unique<ScreenOutput>(settings, parts(), projector, start); }
    void frames(int count, bool asleep = false, bool unused = false, double light = 1.0) {
        for (int k = 0; k < count; ++k) {
            now += milliseconds(100);
            screen->step(
                {.now = now, .tracked_state = state, .light = light, .asleep = asleep, .unused = unused});
        }
    }
    RunStatus told() {
        RunStatus status;
        screen->tell(status);
        return status;
    }

    Log log;
    settings::Settings settings = with_screen();
    LoggedDisplay projector{log, "projector"};
    LoggedDisplay* display = nullptr;
    tracking::TrackedState state;
    MonotonicTime start = from_microseconds(5'000'000);
    MonotonicTime now = start;
    bool no_display = false, no_room = false, moves = true;
    int opened = 0, read = 0;
    double drawn_s = 0.0, drawn_light = 0.0;
    std::vector<glm::dvec3> drawn_eyes_m;
    std::unique_ptr<ScreenOutput> screen; ///< closed first
};

TEST_F(Screen, DrawsOnlyChangesAndRestoresTheProjectorsContext) {
    make();
    EXPECT_EQ(log.lines, (std::vector<std::string>{"screen current", "projector current"}));
    log.lines.clear();
    frames(1);
    EXPECT_EQ(log.lines, (std::vector<std::string>{"screen current", "screen draws", "screen presents",
                                                   "projector current"}));
    frames(29);
    EXPECT_NEAR(drawn_s, 3.0, 1e-9) << "since the run's start";
    EXPECT_EQ(display->presents, 30);
    moves = false;
    frames(30);
    EXPECT_EQ(display->presents, 33) << "at rest, one a second";
    const RunStatus status = told();
    EXPECT_EQ(status.screen.view(), "the screen at DP-1 is lit");
    EXPECT_EQ(status.devices.screen.ok, true);
    ASSERT_TRUE(status.screen_picture);
    EXPECT_EQ(status.screen_picture->health, "well");
    EXPECT_EQ(status.screen_picture->presented, 33U);
    EXPECT_EQ(status.screen_picture->drawn, 30U);
    EXPECT_EQ(status.screen_picture->held_up, 0U);
}

TEST_F(Screen, RewordsTheProjectorsStatesForAScreen) {
    make();
    const auto says = [&](std::string_view of_projector) {
        display->state_ = of_projector;
        return std::string(told().screen.view());
    };
    EXPECT_EQ(says("the graphics card is gone; the exhibit goes on in the dark"),
              "the graphics card is gone; the exhibit goes on without it");
    EXPECT_EQ(says("the projector at DP-1 names no mode; set display.mode and display.force"),
              "the screen at DP-1 names no mode; try another cable");
    EXPECT_EQ(says("a projector is at another graphics card; the exhibit must be restarted to use it"),
              "a screen is at another graphics card; it is opened again while nobody uses the exhibit");
}

TEST_F(Screen, DrawsBothEyesAroundTheVisitorsHead) {
    settings.screen.stereo = settings::OutputStereo::SideBySide;
    settings.eye.interocular_mm = 60.0;
    state.eye_m = {0.1, -0.6, 0.5};
    state.eyes_apart = 1.0;
    make();
    frames(1);
    ASSERT_EQ(drawn_eyes_m.size(), 2U);
    EXPECT_NEAR(glm::distance(drawn_eyes_m[0], drawn_eyes_m[1]), 0.06, 1e-12);
    EXPECT_NEAR(glm::distance(0.5 * (drawn_eyes_m[0] + drawn_eyes_m[1]), state.eye_m), 0.0, 1e-12);
}

TEST_F(Screen, DoesNotWaitForAPictureThatIsNotShownYet) {
    make();
    frames(5);
    display->busy = true;
    frames(20);
    EXPECT_EQ(log.count("screen draws"), 5);
    EXPECT_EQ(told().screen_picture->held_up, 20U);
    EXPECT_EQ(told().screen_picture->health, "well");
    frames(20);
    EXPECT_EQ(told().screen_picture->health, "no_picture");
    EXPECT_EQ(told().devices.screen.impaired, true);
    EXPECT_EQ(told().devices.screen.id, "screen.not_alive");
    EXPECT_EQ(told().screen.view(), "the screen at DP-1: no picture is presented any more");
    display->busy = false;
    frames(1);
    EXPECT_EQ(told().screen_picture->health, "well");
}

TEST_F(Screen, ReportsAFrozenPicture) {
    make();
    frames(60);
    EXPECT_EQ(told().screen_picture->health, "well");
    display->frozen = true;
    frames(60);
    EXPECT_EQ(told().screen_picture->health, "frozen");
}

TEST_F(Screen, ReportsAnUnreadableRoomAndDoesNotReadItAgain) {
    no_room = true;
    make();
    frames(500, false, true);
    EXPECT_EQ(read, 1);
    EXPECT_EQ(opened, 1);
    EXPECT_EQ(log.count("screen closed"), 1);
    EXPECT_EQ(log.lines.back(), "projector current");
    const RunStatus status = told();
    EXPECT_EQ(status.screen.view(), "room.toml: there is no such file");
    EXPECT_EQ(status.devices.screen.ok, false);
    EXPECT_EQ(status.devices.screen.id, "room.no_file");
}

TEST_F(Screen, RetriesAMissingDisplayOnlyWhileNobodyUsesTheExhibit) {
    no_display = true;
    make();
    frames(500);
    EXPECT_EQ(opened, 1) << "a visitor is there";
    EXPECT_EQ(told().devices.screen.id, "screen.no_such_connector");
    frames(300, false, true);
    EXPECT_EQ(opened, 1 + 3);
    no_display = false;
    frames(101, false, true);
    EXPECT_EQ(told().devices.screen.ok, true);
    EXPECT_GT(display->presents, 0);
}

TEST_F(Screen, ReopensADisplayThatFails) {
    make();
    frames(5);
    display->broken = true;
    frames(1);
    EXPECT_EQ(log.count("screen closed"), 1);
    EXPECT_EQ(log.lines.back(), "projector current");
    EXPECT_EQ(told().screen.view(), "the cable has melted");
    EXPECT_EQ(told().devices.screen.ok, false);
    frames(101, false, true);
    EXPECT_EQ(opened, 2);
    EXPECT_EQ(read, 2);
    EXPECT_EQ(told().devices.screen.ok, true);
}

TEST_F(Screen, SleepsWithTheExhibitAndDimsWithIt) {
    make();
    frames(5, false, false, 0.25);
    EXPECT_EQ(drawn_light, 0.25);
    log.lines.clear();
    frames(100, true);
    EXPECT_EQ(log.count("screen dark"), 100);
    EXPECT_EQ(log.count("screen draws"), 0);
    EXPECT_EQ(told().screen_picture->health, "well");
    moves = false;
    frames(1);
    EXPECT_EQ(log.count("screen presents"), 1) << "the first picture after sleep, though nothing moved";
}

TEST_F(Screen, ClosesTheRoomBeforeItsDisplay) {
    struct Ended {
        std::vector<std::string>& lines;
        ~Ended() { lines.emplace_back("room closed"); }
    };
    auto made = parts();
    made.make_room = [this]() -> Result<DrawRoom> {
        return [ended = std::make_shared<Ended>(log.lines)](auto...) {
            static_cast<void>(ended);
            return render::DrawResult{};
        };
    };
    screen = std::make_unique<ScreenOutput>(settings, made, projector, start);
    log.lines.clear();
    made = {};
    screen.reset();
    EXPECT_EQ(log.lines, (std::vector<std::string>{"screen current", "room closed", "screen closed",
                                                   "projector current"}));
}

/// Draws nothing.
class BlankShow final : public Show {
public:
    [[nodiscard]] render::DrawResult draw(MonotonicTime /*now*/, const tracking::TrackedState& /*on_table*/,
                                          const render::RenderTarget& /*target*/,
                                          render::Redraw /*redraw*/) override {
        return {};
    }
    [[nodiscard]] ShowState state() const override { return {}; }
};

TEST_F(Screen, RunLoopStepsTheScreenInEveryFrameAndReportsIt) {
    make();
    BlankShow show;
    Inputs inputs;
    LoopOptions options;
    options.length = seconds(2);
    options.fast = true;
    StatusFile no_file{{.status_file = {}}};
    service::ServiceManager manager;
    const service::Journal journal("test");
    RunWatch watch(manager, journal);
    const auto run = [&] {
        return run_loop(settings, projector, inputs, show, options, no_file, watch, start).value();
    };
    EXPECT_FALSE(run().status.screen_picture);
    EXPECT_EQ(log.count("screen draws"), 0) << "it is not the loop's";
    options.screen = screen.get();
    const LoopResult result = run();
    ASSERT_TRUE(result.status.screen_picture);
    EXPECT_EQ(static_cast<std::uint64_t>(log.count("screen draws")), result.status.frames);
    EXPECT_EQ(result.status.screen.view(), "the screen at DP-1 is lit");
}

} // namespace
} // namespace frustumscreen::show
