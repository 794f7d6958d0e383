// The whole drift check on rendered scenes: the projector shows marks on request, the camera sees them, and
// the report is correct.
#include "app/drift/drift_watch.h"
#include "app/drift/mark_places.h"
#include "app/settings/settings.h"
#include "firmware_host/base/file.h"
#include "tests/base/temporary_folder.h"
#include "tests/drift/table_scene.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <thread>

namespace frustumscreen::drift {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

std::vector<glm::dvec2> shipped_places() {
    settings::Settings settings;
    settings.projector.pinhole = SceneProjector().pinhole;
    settings.projector.table_from_projector = SceneProjector().table_from_projector;
    return mark_places(settings);
}

/// A kiosk with simulated camera and projector.
class Kiosk {
public:
    Kiosk(int width, int height, const SceneFaults& faults, std::vector<SceneTag> tags = {})
        : width(width), height(height), scene(width, height, faults, std::move(tags)) {
        start();
    }

    /// `aside_m`: displacement of the last mark's place, as by another calibration.
    void start(double aside_m = 0.0) {
        shadow = MarkSchedule(marks.size());
        std::vector<glm::dvec2> places = shipped_places();
        places.back().x += aside_m;
        watch = std::make_unique<DriftWatch>(DriftSetUp{std::move(places), {1, 2}, folder / "drift.json"});
    }
    /// Runs this many sets, one per minute. Frames outside the sets are not rendered.
    void run(int sets, const std::vector<SceneHand>& hands = {}) {
        const MonotonicTime end = now + sets * MarkSchedule::between_sets;
        for (; now < end; now += frame_time) {
            const std::optional<ShownMark> mark = watch->step(now, !someone);
            static_cast<void>(shadow.step(now, !someone));
            const MonotonicTime seen = now + milliseconds(40);
            if (shadow.began() && (MarkTimes::moment(seen - *shadow.began(), marks.size()) ||
                                   seen - *shadow.began() >= MarkTimes::length(marks.size()))) {
                see(seen, mark, hands);
            }
        }
    }
    [[nodiscard]] const DriftVerdict& verdict() { return watch->verdict(); }

    int width, height;
    TableScene scene;
    SceneProjector projector;
    std::vector<glm::dvec2> marks = shipped_places();
    MarkSchedule shadow{marks.size()}; ///< steps in parallel with the watch's own
    geometry::RigidTransform real = SceneProjector().table_from_projector;
    std::unique_ptr<DriftWatch> watch;
    TemporaryFolder own_folder;
    std::filesystem::path folder = own_folder.path();
    MonotonicTime now = MonotonicTime(seconds(100));
    Nanoseconds frame_time = milliseconds(66);
    bool someone = false;
    double busy_s = 0.0; ///< CPU time of the camera's thread
    std::uint64_t frames = 0;

private:
    void see(MonotonicTime seen, const std::optional<ShownMark>& mark, const std::vector<SceneHand>& hands) {
        const bool ended = seen - *shadow.began() >= MarkTimes::length(marks.size());
        if (ended && ended_ == shadow.began()) {
            return; // one frame after a set is enough
        }
        ended_ = ended ? shadow.began() : ended_;
        std::optional<TableScene::Light> light;
        if (mark) {
            light = TableScene::Light{projector.light(mark->place_m, real), mark->brightness};
        }
        const camera::CameraFrame frame{seen, ++frames, width, height,
                                        scene.frame(to_seconds(now - *shadow.began()), light, hands)};
        const std::clock_t begin = std::clock();
        watch->use(frame);
        busy_s += static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    }
    std::optional<MonotonicTime> ended_;
};

/// Small for speed: a pixel is 3 mm.
constexpr int small_width = 320, small_height = 180;

TEST(DriftWatch, ReportsAMovedProjector) {
    Kiosk kiosk(small_width, small_height, {});
    EXPECT_EQ(kiosk.verdict().state, DriftState::Learning);
    kiosk.run(4);
    EXPECT_EQ(kiosk.verdict().state, DriftState::Well);
    EXPECT_TRUE(std::filesystem::exists(kiosk.folder / "drift.json"));
    kiosk.real = kiosk.projector.moved({0.005, 0.0, 0.0});
    kiosk.start(); // also after a restart: the reference is on the disk
    kiosk.run(6);
    EXPECT_EQ(kiosk.verdict().state, DriftState::Moved);
    EXPECT_NEAR(kiosk.verdict().off_m, 0.005, 5e-4);
    EXPECT_NE(sentence_of(kiosk.verdict()).view().find("moved by 5 mm since the calibration"),
              std::string_view::npos);
    kiosk.start(1e-4); // after a touch-up
    EXPECT_EQ(kiosk.verdict().state, DriftState::Learning);
}

TEST(DriftWatch, IgnoresHandsAndChangesOfRoomLight) {
    SceneFaults faults;
    faults.room_change = 0.01; // a cloud: a tenth brighter within a set
    Kiosk kiosk(small_width, small_height, faults);
    const std::vector<glm::dvec2> marks = shipped_places();
    const SceneHand lies{marks[0], {0.0, 0.0}};
    const SceneHand passes{marks[1] - glm::dvec2(0.3, 0.0), {0.06, 0.0}};
    kiosk.run(4);
    kiosk.run(6, {lies, passes});
    EXPECT_EQ(kiosk.verdict().state, DriftState::Well);
    EXPECT_GE(kiosk.verdict().marks, 7U);
}

TEST(DriftWatch, ShowsMarksOnlyWithoutVisitors) {
    Kiosk kiosk(small_width, small_height, {});
    kiosk.someone = true;
    kiosk.run(3);
    EXPECT_EQ(kiosk.frames, 0U);
    EXPECT_EQ(kiosk.verdict().looks, 0U);
}

/// As on the kiosk, frames are judged on the camera's thread while this one steps and asks. The two tell each other the time only, in
/// an order that orders nothing else, so the thread sanitizer sees what they share beside it. The frames are dark: no mark is found.
TEST(DriftWatch, ProcessesFramesOnTheCameraThread) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "drift_thread_test";
    DriftWatch watch({shipped_places(), {}, folder / "drift.json"});
    constexpr std::int64_t begin_ms = 100'000, frame_ms = 150;
    std::atomic<std::int64_t> now_ms{begin_ms}, seen_ms{0};
    const std::jthread camera([&](const std::stop_token& stop) {
        camera::CameraFrame frame{{}, 0, small_width, small_height, {}};
        frame.luma.resize(std::size_t{small_width} * small_height);
        while (!stop.stop_requested()) {
            const std::int64_t at_ms = now_ms.load(std::memory_order_relaxed);
            if (at_ms != seen_ms.load(std::memory_order_relaxed)) {
                frame.time = MonotonicTime(milliseconds(at_ms + 40));
                ++frame.number;
                watch.use(frame);
                seen_ms.store(at_ms, std::memory_order_relaxed);
            }
        }
    });
    int marks = 0;
    const std::int64_t end_ms = begin_ms + 3 * 60'000;
    for (std::int64_t at_ms = begin_ms; at_ms < end_ms && watch.verdict().looks == 0; at_ms += frame_ms) {
        now_ms.store(at_ms, std::memory_order_relaxed);
        marks += watch.step(MonotonicTime(milliseconds(at_ms)), true) ? 1 : 0;
        while (seen_ms.load(std::memory_order_relaxed) != at_ms) {
            std::this_thread::yield();
        }
    }
    EXPECT_GT(marks, 0);
    EXPECT_EQ(watch.verdict().looks, 1U);
    EXPECT_EQ(watch.verdict().marks, 0U);
}

TEST(DriftWatch, RelearnsADamagedReference) {
    Kiosk kiosk(small_width, small_height, {});
    ASSERT_TRUE(write_file(kiosk.folder / "drift.json", as_bytes("{")));
    kiosk.start();
    EXPECT_EQ(kiosk.verdict().state, DriftState::Learning);
}

// Figures of docs/calibration.md, at 1280 x 720.

void print_case(const char* name, const SceneFaults& faults, const std::vector<SceneHand>& hands) {
    std::printf("%s:", name);
    Kiosk kiosk(1280, 720, faults);
    kiosk.run(4);
    for (const double move_mm : {0.0, 1.0, 2.0, 5.0}) {
        kiosk.start(); // the result of a single measurement
        const double busy_before_s = kiosk.busy_s;
        const std::uint64_t frames_before = kiosk.frames;
        kiosk.real = kiosk.projector.moved({0.6e-3 * move_mm, 0.8e-3 * move_mm, 0.0});
        kiosk.run(1, hands);
        std::printf(" %.0f -> %.2f mm (%zu marks, %.2f ms a frame)%s", move_mm, 1e3 * kiosk.verdict().off_m,
                    kiosk.verdict().marks,
                    1e3 * (kiosk.busy_s - busy_before_s) / static_cast<double>(kiosk.frames - frames_before),
                    move_mm < 5.0 ? ";" : "\n");
        std::fflush(stdout);
    }
}

TEST(DriftWatch, DISABLED_PrintsAccuracyInRenderedScenes) {
    const std::vector<glm::dvec2> marks = shipped_places();
    print_case("as usual", {}, {});
    print_case("three times the noise", {.noise = 4.5}, {});
    print_case("room as bright as the projector", {.room = 1.0, .exposure = 0.4}, {});
    print_case("a cloud goes", {.room_change = 0.02}, {});
    print_case("out of focus by 5 mm", {.blur_m = 0.005}, {});
    print_case("marks of a quarter of the light", {.mark_light = 0.06}, {});
    print_case("hands on three marks", {},
               {{marks[0], {0.0, 0.0}}, {marks[3], {0.01, 0.0}}, {marks[5], {0.0, 0.02}}});
}

} // namespace
} // namespace frustumscreen::drift
