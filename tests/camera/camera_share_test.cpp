// CPU time of the camera's thread, in shares of one core, with every use of its frames on: MJPEG of 1280 x
// 720 at 30 Hz, decoded, checked, and passed to the prop's tags, the visitor's eye and the drift check, by
// the exhibit's own code from the kernel's buffer on.
//
// No camera place suits all uses: tags and drift marks are detected on a table seen from above, heads in a
// room seen from the table's far edge. The table `camera` of docs/measurements.md: `ctest -C long -R camera_share`,
// with FRUSTUMSCREEN_FIGURES (docs/bench.md).
#include "app/drift/drift_watch.h"
#include "app/drift/mark_places.h"
#include "app/programs/devices/wiring.h"
#include "app/tags/tag_reader.h"
#include "app/visitor/visitor_reader.h"
#include "firmware_host/camera/camera_driver.h"
#include "tests/base/write_figures.h"
#include "tests/camera/fake_v4l2.h"
#include "tests/drift/table_scene.h"
#include "tests/simulators/tags/skirt.h"
#include "tests/simulators/visitor/room_scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <linux/videodev2.h>
#include <turbojpeg.h>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>

namespace frustumscreen::camera {
namespace {

using std::chrono::seconds;

constexpr int width = 1280, height = 720;
constexpr double rate_hz = 30.0;

/// Compressed like a webcam's picture: chroma at half width.
Picture jpeg_of(const Picture& grey) {
    Picture colours;
    for (const std::uint8_t code : grey) {
        colours.insert(colours.end(), {code, static_cast<std::uint8_t>(code - code / 16), code});
    }
    tjhandle handle = ::tjInitCompress();
    unsigned char* file = nullptr;
    unsigned long size = 0;
    ::tjCompress2(handle, colours.data(), width, 0, height, TJPF_RGB, &file, &size, TJSAMP_422, 85, 0);
    Picture bytes(file, file + size);
    ::tjFree(file);
    ::tjDestroy(handle);
    return bytes;
}

/// The tags around a prop, all with equal orientation.
std::vector<tags::PropTag> prop_tags() {
    std::vector<tags::PropTag> tags = simulators::tags_of({});
    for (tags::PropTag& tag : tags) {
        tag.prop_from_tag.rotation = tags.front().prop_from_tag.rotation;
    }
    return tags;
}

/// The tags lie flat in the table's middle; only noise differs between the pictures.
std::vector<Picture> table_pictures(std::size_t count) {
    std::vector<drift::SceneTag> tags;
    for (const tags::PropTag& tag : prop_tags()) {
        tags.push_back({tag.id, glm::dvec2(tag.prop_from_tag.translation), tag.size_m});
    }
    drift::TableScene scene(width, height, {}, tags);
    std::vector<Picture> pictures;
    for (std::size_t k = 0; k < count; ++k) {
        pictures.push_back(jpeg_of(scene.frame(0.0, std::nullopt)));
    }
    return pictures;
}

simulators::WatchingCamera watching(int columns, int rows) {
    simulators::WatchingCamera camera;
    camera.pinhole = camera.pinhole.scaled_to(columns, rows);
    return camera;
}

struct Room {
    int columns, rows;
    std::vector<Picture> pictures;
};

/// Two seconds without visitors; then a person stands there and sways for two more.
Room room_of(int columns, int rows) {
    std::mt19937_64 random(1);
    simulators::Person person = simulators::any_person(simulators::Build::Adult, random);
    person.holds = true;
    const glm::dvec2 table_size_m(0.8, 0.5);
    const glm::dvec3 stands = simulators::any_eye(simulators::Build::Adult, 0.1, 0.12, table_size_m, random);
    const simulators::RoomScene scene(watching(columns, rows), {}, table_size_m,
                                      geometry::make_frustum(geometry::shipped_frustum), glm::dvec3(0.0));
    const auto bodies = [&](double t_s) {
        std::vector<std::vector<simulators::Ball>> all;
        if (t_s > 2.0) {
            all.push_back(
                simulators::body_of(person, stands + simulators::sway(person, t_s), {0.0, 0.0, 0.08}));
        }
        return all;
    };
    Room room{columns, rows, {}};
    for (std::uint64_t k = 0; k < 120; ++k) {
        room.pictures.push_back(scene.picture(
            bodies, [](double) { return simulators::LightNow{}; }, static_cast<double>(k) / rate_hz, k));
    }
    return room;
}

/// The view of TableScene; the camera's place makes no difference here.
tags::TagSetUp tag_set_up() {
    const double focal = 1.3 * width / 0.95;
    return {{width, height, focal, focal, 0.5 * width, 0.5 * height, {-0.08, 0.0}}, {}, prop_tags()};
}

std::vector<glm::dvec2> marks() {
    settings::Settings settings;
    settings.projector.pinhole = drift::SceneProjector().pinhole;
    settings.projector.table_from_projector = drift::SceneProjector().table_from_projector;
    return drift::mark_places(settings);
}

struct On {
    bool tags = false, visitor = false, drift = false;
};

struct Spent {
    double share = 0.0;    ///< of one core
    double frame_ms = 0.0; ///< CPU time per used frame
    double used_hz = 0.0;
    double poses_hz = 0.0;
    double heads_hz = 0.0;
};

using Busy = std::function<double()>;

class Kiosk {
public:
    /// `busy`: CPU seconds of the thread; `each`: the CPU clock of each use, which has a share of its own.
    Kiosk(const std::vector<Picture>& table, const Room& room, On on, double share,
          const Busy& busy = thread_seconds, const Busy& each = thread_seconds)
        : room_(room), on_(on), seen_{{}, 1, room.columns, room.rows, {}}, tags_(tag_set_up(), each),
          visitor_({watching(room.columns, room.rows).pinhole,
                    watching(room.columns, room.rows).table_from_camera(),
                    {}},
                   each),
          driver_(
              devices(table), {}, [this] { return *camera_.now; },
              [this](const CameraFrame& frame) { use(frame); }, CpuThrottle(share, busy)) {}

    /// Ten seconds; the first four, in which the background is learnt and the visitor arrives, do not count.
    Spent run() {
        CameraFrame frame;
        const MonotonicTime begin = *camera_.now;
        const MonotonicTime warm = begin + seconds(4);
        const MonotonicTime end = begin + seconds(10);
        std::optional<double> began_s;
        while (*camera_.now < end) {
            if (*camera_.now >= warm && !began_s) {
                began_s = thread_seconds();
                used_ = poses_ = heads_ = 0;
            }
            static_cast<void>(drift_.step(*camera_.now, on_.drift));
            *camera_.now += driver_.step(frame).pause;
        }
        const double busy_s = thread_seconds() - *began_s;
        const double measured_s = to_seconds(end - warm);
        return {busy_s / measured_s, 1e3 * busy_s / used_, used_ / measured_s, poses_ / measured_s,
                heads_ / measured_s};
    }

private:
    std::unique_ptr<FakeDevices> devices(const std::vector<Picture>& table) {
        make_usual(camera_);
        camera_.formats = {{V4L2_PIX_FMT_MJPEG, {{width, height, {30}}}}};
        camera_.picture = [&table](std::uint64_t number) { return table[number % table.size()]; };
        return std::make_unique<FakeDevices>(std::vector{&camera_});
    }
    void use(const CameraFrame& frame) {
        used_ += 1.0;
        if (on_.tags) {
            poses_ += tags_.read(frame) ? 1.0 : 0.0;
        }
        if (on_.visitor) { // a separate picture; after the last one, the final second repeats forwards and
                           // backwards
            const auto at = static_cast<std::size_t>(to_seconds(frame.time - begin_) * rate_hz);
            const std::size_t last = room_.pictures.size() - 1;
            const std::size_t back = at % 60 < 30 ? at % 60 : 59 - at % 60;
            seen_.time = frame.time;
            seen_.luma = room_.pictures[at <= last ? at : last - back];
            heads_ += visitor_.read(seen_).empty() ? 0.0 : 1.0;
        }
        if (on_.drift) {
            drift_.use(frame);
        }
    }

    const Room& room_;
    On on_;
    FakeCamera camera_;
    MonotonicTime begin_ = *camera_.now;
    double used_ = 0.0, poses_ = 0.0, heads_ = 0.0;
    CameraFrame seen_;
    tags::TagReader tags_;
    visitor::VisitorReader visitor_;
    drift::DriftWatch drift_{{marks(), {}, std::filesystem::path(testing::TempDir()) / "share_drift.json"}};
    CameraDriver driver_;
};

constexpr const char* figures_header = "use,max_share,frame_ms,used_hz,share,poses_hz,heads_hz\n";

std::string figures_line(std::string_view use, double max_share, const Spent& spent) {
    return fmt::format("{},{:.2f},{:.2f},{:.2f},{:.4f},{:.2f},{:.2f}\n", use, max_share, spent.frame_ms,
                       spent.used_hz, spent.share, spent.poses_hz, spent.heads_hz);
}

/// Each frame takes 16 ms, so 15 or 16 of 30 are used: each gives a pose and a head.
TEST(CameraShare, SkippedFramesLoseNeitherTagsNorVisitor) {
    double busy_s = 0.0;
    const std::vector<Picture> table = table_pictures(10);
    const Room room = room_of(640, 360);
    Kiosk kiosk(
        table, room, {true, true, true}, programs::max_camera_share, [&busy_s] { return busy_s += 0.016; },
        [] { return 0.0; });
    const Spent spent = kiosk.run();
    EXPECT_NEAR(spent.used_hz, programs::max_camera_share / 0.016, 1.5);
    EXPECT_EQ(spent.poses_hz, spent.used_hz);
    EXPECT_GT(spent.heads_hz, 0.9 * spent.used_hz);
}

TEST(CameraShare, DISABLED_TheFigures) {
    const std::vector<Picture> table = table_pictures(30);
    const Room room = room_of(width, height);
    std::printf("a frame has %.0f kB\n", 1e-3 * static_cast<double>(table.front().size()));
    std::string csv = figures_header;
    for (const double max_share : {1.0, programs::max_camera_share}) {
        const auto spent = [&](On on) { return Kiosk(table, room, on, max_share).run(); };
        csv += figures_line("none: decoded and judged", max_share, spent({}));
        csv += figures_line("tags", max_share, spent({.tags = true}));
        csv += figures_line("visitor", max_share, spent({.visitor = true}));
        csv += figures_line("drift while it looks", max_share, spent({.drift = true}));
        const Spent all = spent({true, true, true});
        csv += figures_line("all three", max_share, all);
        EXPECT_LT(all.share, max_share + 0.02);
        EXPECT_GT(all.poses_hz, 5.0);
        EXPECT_GT(all.heads_hz, 5.0);
    }
    std::printf("%s", csv.c_str());
    write_figures("camera_share.csv", csv);
}

} // namespace
} // namespace frustumscreen::camera
