// Passes the frames of a minute or more to every use of the exhibit's camera frames: the prop's tags, the
// visitor's eye, the drift marks, which are learnt, and the staff's view; prints their number.
// keeps_nothing_test runs it under strace.
//
//   uses_in_memory FOLDER [FILE] FOLDER: for drift.json; FILE: does the forbidden thing: one frame is written
//   there
#include "app/drift/drift_watch.h"
#include "app/drift/mark_places.h"
#include "app/settings/looking_at.h"
#include "app/show/viewfinder.h"
#include "app/tags/tag_tracker.h"
#include "app/visitor/visitor_tracker.h"
#include "tests/drift/table_scene.h"
#include "tests/simulators/tags/skirt.h"
#include "tests/simulators/tags/tag_scene.h"

#include <cstdio>
#include <filesystem>

namespace frustumscreen::camera {
namespace {

using std::chrono::milliseconds;

constexpr int width = 320, height = 180;

std::vector<glm::dvec2> marks() {
    settings::Settings settings;
    settings.projector.pinhole = drift::SceneProjector().pinhole;
    settings.projector.table_from_projector = drift::SceneProjector().table_from_projector;
    return drift::mark_places(settings);
}

/// Returns whether a pose was found.
bool find_tags() {
    simulators::SceneCamera camera;
    camera.table_from_camera = *settings::looking_at({0.1, -0.2, 1.25}, {0.0, 0.0, 0.0}, 0.0);
    tags::TagTracker tags({camera.pinhole, camera.table_from_camera, simulators::tags_of({})});
    const simulators::TagScene scene(geometry::make_frustum(geometry::shipped_frustum),
                                     simulators::tags_of({}), camera, {});
    const CameraFrame frame{MonotonicTime(milliseconds(1000)), 1, camera.pinhole.width, camera.pinhole.height,
                            scene.picture(
                                [](double) {
                                    return geometry::RigidTransform{{1, 0, 0, 0}, {0.04, -0.03, 0.0}};
                                },
                                1)};
    tags.use(frame);
    std::vector<tracking::UncertainPose> poses;
    tags.poll(MonotonicTime(std::chrono::hours(1)), poses);
    return !poses.empty();
}

/// Frames of an empty table, until the marks' places are learnt.
class Frames {
public:
    explicit Frames(const std::filesystem::path& folder)
        : folder_(folder), drift_({marks_, {}, folder / "drift.json"}),
          visitor_({{width, height, 300.0, 300.0, width / 2.0, height / 2.0},
                    *settings::looking_at({0.0, 0.4, 0.5}, {0.0, -0.4, 0.4}, 0.0),
                    {}}) {}

    unsigned long run() {
        for (; count_ < 10'000 && !std::filesystem::exists(folder_ / "drift.json");
             now_ += milliseconds(66)) {
            const std::optional<drift::ShownMark> mark = drift_.step(now_, true);
            static_cast<void>(shadow_.step(now_, true));
            if (!shadow_.began() ||
                now_ - *shadow_.began() > drift::MarkTimes::length(marks_.size()) + milliseconds(200)) {
                continue; // no mark is expected
            }
            std::optional<drift::TableScene::Light> light;
            if (mark) {
                light = drift::TableScene::Light{mark->place_m, mark->brightness};
            }
            frame = {now_ + milliseconds(40), ++count_, width, height, scene_.frame(0.0, light)};
            drift_.use(frame);
            visitor_.use(frame);
            viewfinder_.want(count_ % 20 < 10);
            viewfinder_.use(frame);
            seen += viewfinder_.take(picture_) ? 1U : 0U;
        }
        visitor_.poll(now_, heads_);
        return count_;
    }
    CameraFrame frame;
    unsigned long seen = 0;

private:
    std::filesystem::path folder_;
    std::vector<glm::dvec2> marks_ = marks();
    drift::MarkSchedule shadow_{marks_.size()}; ///< steps in parallel with the watch's own
    drift::DriftWatch drift_;
    visitor::VisitorTracker visitor_;
    show::Viewfinder viewfinder_{{320, 240}, 1};
    image::Image8 picture_{320, 240};
    std::vector<tracking::SeenHead> heads_;
    drift::TableScene scene_{width, height, {}};
    MonotonicTime now_{std::chrono::seconds(100)};
    unsigned long count_ = 0;
};

} // namespace
} // namespace frustumscreen::camera

int main(int argc, char** argv) {
    using namespace frustumscreen;
    using namespace frustumscreen::camera;
    if (argc < 2 || !find_tags()) {
        return 1;
    }
    Frames frames(argv[1]);
    const unsigned long count = frames.run();
    if (argc > 2) {
        std::FILE* const file = std::fopen(argv[2], "wb");
        std::fwrite(frames.frame.luma.data(), 1, frames.frame.luma.size(), file);
        std::fclose(file);
    }
    std::printf("%s frames\n", count > 100 && frames.seen > 10 ? "enough" : "too few");
}
