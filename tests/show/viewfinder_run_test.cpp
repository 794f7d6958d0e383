// The camera's picture reaches the staff picture while they hold their buttons, and nothing of it remains before or
// after.

#include "app/render/read_back.h"
#include "app/show/live_exhibit.h"
#include "app/show/run_loop.h"
#include "firmware_host/display/surfaceless_display.h"
#include "tests/exhibit/exhibits.h"
#include "tests/render/counted_new.h"
#include "tests/show/viewfinder_frames.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <future>
#include <thread>

namespace frustumscreen::show {
namespace {

using namespace viewfinder_frames;
using std::chrono::milliseconds;
using std::chrono::seconds;

/// Staff who press both buttons at the start, and release them.
class HeldPanel final : public panel::Panel {
public:
    HeldPanel(MonotonicTime start, Nanoseconds held) : start_(start), held_(held) {}
    [[nodiscard]] Result<void> poll(MonotonicTime now, std::vector<panel::PanelEvent>& events) override {
        if (!said_ && now - start_ >= chord) {
            events.push_back({now, 0, panel::PressKind::Chord});
            said_ = true;
        }
        return {};
    }
    [[nodiscard]] bool chord_held(MonotonicTime now) const override { return now - start_ < held_; }
    [[nodiscard]] std::string name() const override { return "held"; }
    static constexpr Nanoseconds chord = seconds(1);

private:
    MonotonicTime start_;
    Nanoseconds held_;
    bool said_ = false;
};

/// A camera in a state given by the test.
class StatedCamera final : public camera::Camera {
public:
    [[nodiscard]] bool poll(camera::CameraFrame& /*frame*/) override { return false; }
    [[nodiscard]] camera::CameraState state() const override { return now; }
    [[nodiscard]] double rate_hz() const override { return 30.0; }
    [[nodiscard]] camera::CameraCounts counts() const override { return {}; }
    [[nodiscard]] std::optional<camera::CameraSetUp> set_up() const override { return std::nullopt; }
    camera::CameraState now = camera::CameraState::Running;
};

/// Passes everything on to a show, gives the viewfinder a frame before each picture, and examines the picture.
class LookedAt final : public Show {
public:
    LookedAt(Show& show, Viewfinder* viewfinder) : show_(show), viewfinder_(viewfinder) {}
    void step(MonotonicTime now, std::span<const settings::Command> commands,
              const tracking::TrackedState& on_table) override {
        show_.step(now, commands, on_table);
    }
    void set_viewfinder(Viewfinder* viewfinder) override {
        held = viewfinder != nullptr;
        show_.set_viewfinder(viewfinder);
    }
    void tell(const RunStatus& status) override { show_.tell(status); }
    [[nodiscard]] ShowState state() const override { return show_.state(); }
    [[nodiscard]] render::DrawResult draw(MonotonicTime now, const tracking::TrackedState& on_table,
                                          const render::RenderTarget& target,
                                          render::Redraw redraw) override {
        if (viewfinder_ != nullptr) {
            viewfinder_->use(frame);
        }
        const long before = synthetic::allocations_so_far();
        const render::DrawResult drawn = show_.draw(now, on_table, target, redraw);
        allocated = synthetic::allocations_so_far() - before;
        after_draw(now, target.framebuffer);
        return drawn;
    }

    camera::CameraFrame frame = frame_of(2 * area_px.x, 2 * area_px.y, 11);
    bool held = false;
    long allocated = 0;
    std::function<void(MonotonicTime, unsigned)> after_draw;

private:
    Show& show_;
    Viewfinder* viewfinder_;
};

class ViewfinderRun : public testing::Test {
protected:
    void SetUp() override {
        settings.projector.pinhole = {width, height, 960.0, 960.0, width / 2.0, height / 2.0};
        settings.camera.kind = settings::CameraKind::V4l2;
        auto made = display::SurfacelessDisplay::create(width, height);
        ASSERT_TRUE(made) << made.error().message;
        display = std::move(*made);
    }
    void with_viewfinder() {
        inputs.viewfinder = std::make_unique<Viewfinder>(area_px, 0);
        inputs.panel = std::make_unique<HeldPanel>(start, seconds(3));
    }
    /// A pattern with the fixture's settings, or without a camera.
    std::unique_ptr<PatternShow> pattern() {
        auto made = PatternShow::create(settings);
        EXPECT_TRUE(made);
        return std::move(*made);
    }
    void run(LookedAt& show, Nanoseconds length) {
        LoopOptions options;
        options.length = length;
        options.fast = true;
        options.screenshot = screenshot;
        StatusFile no_file{{.status_file = {}}};
        service::ServiceManager manager;
        const service::Journal journal("test");
        RunWatch watch(manager, journal);
        const Result<LoopResult> result =
            run_loop(settings, *display, inputs, show, options, no_file, watch, start);
        EXPECT_TRUE(result) << result.error().message;
    }
    /// The camera's part of the picture: at the lower right, with the line below.
    static image::Image8 part_of(const image::Image8& picture) {
        image::Image8 part(area_px.x, area_px.y);
        for (int y = 0; y < area_px.y; ++y) {
            for (int x = 0; x < area_px.x; ++x) {
                part.at(x, y) = picture.at(width - 24 - area_px.x + x, height - 24 - 90 - area_px.y + y);
            }
        }
        return part;
    }
    /// Compares without the watchdog's code.
    static bool are_equal(const image::Image8& a, const image::Image8& b) {
        return std::equal(a.texels.begin() + width, a.texels.end(), b.texels.begin() + width);
    }

    settings::Settings settings;
    std::unique_ptr<display::SurfacelessDisplay> display;
    Inputs inputs;
    MonotonicTime start = MonotonicTime(seconds(100));
    Screenshot* screenshot = nullptr;
};

TEST_F(ViewfinderRun, StaffPictureShowsTheCameraOnlyWhileBothButtonsAreHeld) {
    settings.camera.kind = settings::CameraKind::None;
    image::Image8 plain;
    {
        const std::unique_ptr<PatternShow> show = pattern();
        LookedAt looked(*show, nullptr);
        looked.after_draw = [&](MonotonicTime, unsigned fb) {
            plain = render::read_colour(fb, width, height);
        };
        run(looked, milliseconds(100));
    }
    settings.camera.kind = settings::CameraKind::V4l2;
    with_viewfinder();
    const std::unique_ptr<PatternShow> show = pattern();
    LookedAt looked(*show, inputs.viewfinder.get());
    int with = 0, without = 0;
    long allocated = 0;
    looked.after_draw = [&](MonotonicTime now, unsigned fb) {
        const image::Image8 picture = render::read_colour(fb, width, height);
        const bool is_held = now - start < seconds(3) && now > start; // the first frame establishes the state
        ASSERT_EQ(looked.held, is_held);
        if (!is_held) {
            ++without;
            ASSERT_TRUE(are_equal(picture, plain)) << "as in an exhibit without a camera";
            ASSERT_FALSE(holds(*inputs.viewfinder, looked.frame));
            return;
        }
        Grey grey(looked.frame.width, looked.frame.height);
        grey.texels = looked.frame.luma;
        expect_mean_of(grey, 2, part_of(picture));
        allocated += with > 2 ? looked.allocated : 0;
        looked.frame =
            frame_of(2 * area_px.x, 2 * area_px.y, static_cast<std::uint32_t>(++with)); // a new frame
    };
    run(looked, seconds(6));
    EXPECT_GT(with, 170);
    EXPECT_GT(without, 170);
    if (synthetic::allocations_are_counted) {
        EXPECT_EQ(allocated, 0);
    }
}

/// A visitor who holds two buttons does not see the camera's picture: the staff picture appears with the chord.
TEST_F(ViewfinderRun, HoldsNoFrameBeforeTheStaffPictureAppears) {
    settings.panel.kind = settings::PanelKind::Gpio;
    settings.panel.lines = {"4", "5", "6"};
    class Nothing final : public PresentationShow {
    public:
        [[nodiscard]] render::DrawResult draw(MonotonicTime, const exhibit::Presentation&,
                                              std::span<const glm::dvec3>, const render::RenderTarget&,
                                              render::Redraw) override {
            return {true, {}, {}, 1};
        }
        [[nodiscard]] ShowState state(const exhibit::Presentation& presentation) const override {
            ShowState state;
            state.state = presentation.state;
            return state;
        }
    };
    with_viewfinder();
    LiveExhibit live(settings, std::make_unique<Nothing>(), sample::exhibit(3, {"en"}), "a driver");
    LookedAt looked(live, inputs.viewfinder.get());
    looked.frame = frame_of(area_px.x, area_px.y, 11); // not shrunk, so that its bytes can be found
    int with = 0;
    looked.after_draw = [&](MonotonicTime now, unsigned fb) {
        const bool is_held = now - start > HeldPanel::chord + milliseconds(20) && now - start < seconds(3);
        const bool is_not = now - start < HeldPanel::chord || now - start >= seconds(3);
        if (is_held) {
            Grey grey(looked.frame.width, looked.frame.height);
            grey.texels = looked.frame.luma;
            expect_mean_of(grey, 1, part_of(render::read_colour(fb, width, height)));
            ++with;
        } else if (is_not) {
            ASSERT_FALSE(holds(*inputs.viewfinder, looked.frame));
            ASSERT_FALSE(looked.held);
        }
    };
    run(looked, seconds(5));
    EXPECT_GT(with, 100);
}

TEST_F(ViewfinderRun, ACoveredCameraShowsASentenceInsteadOfItsPicture) {
    with_viewfinder();
    auto stated = std::make_unique<StatedCamera>();
    StatedCamera& camera = *stated;
    inputs.camera = std::move(stated);
    const std::unique_ptr<PatternShow> show = pattern();
    LookedAt looked(*show, inputs.viewfinder.get());
    looked.frame = frame_of(area_px.x, area_px.y, 11);
    image::Image8 running, covered;
    looked.after_draw = [&](MonotonicTime now, unsigned fb) {
        const Nanoseconds at = now - start;
        camera.now = at < milliseconds(1500) ? camera::CameraState::Running : camera::CameraState::Dark;
        if (at > milliseconds(1400) && at < milliseconds(1500)) {
            running = render::read_colour(fb, width, height);
            ASSERT_TRUE(holds(*inputs.viewfinder, looked.frame));
        } else if (at > milliseconds(1550) && at < seconds(3)) {
            covered = render::read_colour(fb, width, height);
            ASSERT_FALSE(holds(*inputs.viewfinder, looked.frame));
        }
    };
    run(looked, seconds(4));
    const image::Image8 part = part_of(covered);
    EXPECT_TRUE(std::all_of(part.texels.begin(), part.texels.end(),
                            [](const glm::u8vec4& code) { return code == glm::u8vec4(0, 0, 0, 255); }));
    const auto lit_below = [](const image::Image8& picture) {
        int lit = 0;
        for (int y = height - 24 - 90; y < height - 24; ++y) {
            for (int x = width - 24 - area_px.x; x < width - 24; ++x) {
                lit += picture.at(x, y).r > 100 ? 1 : 0;
            }
        }
        return lit;
    };
    EXPECT_GT(lit_below(running), 50);
    EXPECT_GT(lit_below(covered), 50);
    EXPECT_NE(lit_below(running), lit_below(covered)) << "another sentence";
}

TEST_F(ViewfinderRun, ScreenshotsDoNotContainTheCameraPicture) {
    with_viewfinder();
    Screenshot asked(width, height, std::chrono::hours(1)); // measured by frame time, not by the wall clock
    screenshot = &asked;
    const std::unique_ptr<PatternShow> show = pattern();
    LookedAt looked(*show, inputs.viewfinder.get());
    std::future<image::Image8> got;
    bool shown_with = false;
    looked.after_draw = [&](MonotonicTime, unsigned fb) {
        if (!looked.held) {
            return;
        }
        shown_with = shown_with || part_of(render::read_colour(fb, width, height)).at(area_px.x / 2, 3).r > 0;
        if (!got.valid()) {
            got = std::async(std::launch::async, [&] {
                const Result<const image::Image8*> picture = asked.take(std::stop_token());
                return picture ? **picture : image::Image8();
            });
            std::this_thread::sleep_for(milliseconds(50)); // the request is made
        }
        ASSERT_NE(got.wait_for(milliseconds(0)), std::future_status::ready);
    };
    run(looked, seconds(5));
    ASSERT_TRUE(shown_with);
    while (got.wait_for(milliseconds(1)) != std::future_status::ready) {
        asked.serve(*display); // the request may come only now
    }
    const image::Image8 picture = got.get();
    ASSERT_EQ(picture.width, width);
    EXPECT_TRUE(are_equal(picture, render::read_colour(display->framebuffer(), width, height)))
        << "that of after the buttons were let go";
}

/// The number of times that the bytes occur in this process's memory. `needle` is kept encoded, so that it does not
/// match itself.
std::size_t occurrences(const std::vector<std::uint8_t>& needle) {
    constexpr std::uint8_t disguise = 0x5A;
    std::ifstream maps("/proc/self/maps");
    const int memory = ::open("/proc/self/mem", O_RDONLY | O_CLOEXEC);
    EXPECT_GE(memory, 0);
    static std::vector<std::uint8_t> part(1U << 20U);
    std::size_t found = 0;
    for (std::string line; std::getline(maps, line);) {
        unsigned long begin = 0, end = 0;
        char readable = 0, writable = 0;
        if (std::sscanf(line.c_str(), "%lx-%lx %c%c", &begin, &end, &readable, &writable) != 4 ||
            readable != 'r' || writable != 'w') {
            continue;
        }
        for (unsigned long at = begin; at < end; at += part.size() - needle.size()) {
            const auto size = std::min<unsigned long>(part.size(), end - at);
            const auto from = reinterpret_cast<unsigned long>(part.data());
            const ssize_t read = ::pread(memory, part.data(), size, static_cast<off_t>(at));
            const std::size_t got = read > 0 ? static_cast<std::size_t>(read) : 0;
            for (std::size_t k = 0; k + needle.size() <= got; ++k) {
                std::size_t same = 0;
                while (same < needle.size() &&
                       part[k + same] == static_cast<std::uint8_t>(needle[same] ^ disguise)) {
                    ++same;
                }
                const bool is_own_copy = at + k < from + part.size() && from < at + k + needle.size();
                found += same == needle.size() && !is_own_copy ? 1 : 0;
            }
        }
        std::fill(part.begin(), part.end(), std::uint8_t{0});
    }
    ::close(memory);
    return found;
}

/// Searches the whole process, including the driver that draws on the processor.
TEST_F(ViewfinderRun, LeavesNoCameraFrameInTheProcessMemory) {
    if (!synthetic::allocations_are_counted) {
        GTEST_SKIP() << "the sanitizers keep freed memory as it is";
    }
    with_viewfinder();
    const std::unique_ptr<PatternShow> show = pattern();
    LookedAt looked(*show, inputs.viewfinder.get());
    looked.frame = frame_of(area_px.x, area_px.y, 99);
    const auto disguised = [&](int channels) {
        std::vector<std::uint8_t> needle;
        for (std::size_t k = 0; k < 12; ++k) {
            const std::uint8_t code = looked.frame.luma[static_cast<std::size_t>(20 * area_px.x + 10) + k];
            for (int c = 0; c < channels; ++c) {
                needle.push_back(static_cast<std::uint8_t>((c == 3 ? 255 : code) ^ 0x5A));
            }
        }
        return needle;
    };
    const std::vector<std::uint8_t> grey = disguised(1), colour = disguised(4);
    std::size_t while_held = 0, colour_while_held = 0;
    looked.after_draw = [&](MonotonicTime now, unsigned) {
        if (now - start > milliseconds(500) && while_held == 0) {
            render::wait_until_drawn(); // the driver draws on its own threads
            while_held = occurrences(grey);
            colour_while_held = occurrences(colour);
        }
        if (now - start > seconds(3)) { // erases the test's own copy
            std::fill(looked.frame.luma.begin(), looked.frame.luma.end(), std::uint8_t{1});
        }
    };
    run(looked, milliseconds(3200));
    render::wait_until_drawn();
    EXPECT_GE(while_held, 2U) << "the camera's own, and the viewfinder's";
    EXPECT_GE(colour_while_held, 3U) << "the panel's, the texture's and the framebuffer's";
    EXPECT_EQ(occurrences(grey), 0U);
    EXPECT_EQ(occurrences(colour), 0U);
}

} // namespace
} // namespace frustumscreen::show
