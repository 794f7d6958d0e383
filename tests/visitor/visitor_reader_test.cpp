#include "app/settings/settings.h"
#include "app/visitor/visitor_tracker.h"
#include "tests/base/text_of.h"
#include "tests/folders.h"
#include "tests/simulators/visitor/visitor_run.h"

#include <gtest/gtest.h>

#include <iterator>
#include <thread>

namespace frustumscreen::visitor {
namespace {

using std::chrono::milliseconds;

const glm::dvec3 prop(0.05, 0.0, 0.0);
const glm::dvec3 eye(0.1, -0.42, 0.6);

/// A table, optionally with a person at it.
const simulators::RoomScene& scene() {
    static const simulators::RoomScene one({}, {}, {0.8, 0.5},
                                           geometry::make_frustum(geometry::shipped_frustum), prop);
    return one;
}

camera::CameraFrame frame_at(milliseconds time, bool is_there, std::uint64_t seed) {
    static const simulators::Person person = [] {
        std::mt19937_64 random(2);
        return simulators::any_person(simulators::Build::Adult, random);
    }();
    const simulators::Bodies bodies = [&](double /*t_s*/) {
        return is_there ? std::vector<std::vector<simulators::Ball>>{simulators::body_of(
                              person, eye, prop + glm::dvec3(0, 0, 0.08))}
                        : std::vector<std::vector<simulators::Ball>>{};
    };
    const geometry::Pinhole& pinhole = scene().camera().pinhole;
    return {MonotonicTime(time), 1, pinhole.width, pinhole.height,
            scene().picture(
                bodies, [](double) { return simulators::LightNow{}; }, 0.0, seed)};
}

VisitorSetUp set_up() {
    return {scene().camera().pinhole, scene().table_from_camera(), {}};
}

/// Frames at `rate_hz` from two pictures, which change only in their time.
class Played {
public:
    explicit Played(VisitorReader& reader) : reader_(reader) {}
    /// Returns the heads of the last frame.
    std::vector<tracking::SeenHead> play(bool is_there, double seconds, int rate_hz) {
        std::vector<tracking::SeenHead> heads;
        for (int k = 0; k < static_cast<int>(seconds * rate_hz); ++k) {
            time_ += milliseconds(1000 / rate_hz);
            camera::CameraFrame& frame = is_there ? there_ : nobody_;
            frame.time = MonotonicTime(time_);
            const auto seen = reader_.read(frame);
            heads.assign(seen.begin(), seen.end());
        }
        return heads;
    }

private:
    VisitorReader& reader_;
    camera::CameraFrame nobody_ = frame_at(milliseconds(0), false, 1);
    camera::CameraFrame there_ = frame_at(milliseconds(0), true, 2);
    milliseconds time_{1000};
};

double free_of_charge() {
    return 0.0;
}

TEST(VisitorReader, DetectsArrivalAndDeparture) {
    VisitorReader reader(set_up(), free_of_charge);
    Played played(reader);
    EXPECT_TRUE(played.play(false, 1.5, 30).empty());
    const std::vector<tracking::SeenHead> heads = played.play(true, 0.5, 30);
    ASSERT_EQ(heads.size(), 1U);
    const glm::dvec3 line = glm::normalize(eye - prop);
    const glm::dvec3 off = tracking::eye_of_head(heads[0].middle_m, prop + glm::dvec3(0, 0, 0.08)) - eye;
    EXPECT_LT(glm::length(glm::cross(off, line)), 0.045);
    EXPECT_LT(glm::length(off), 0.2);
    EXPECT_GT(heads[0].across_sd_m, 0.01);
    EXPECT_LT(heads[0].across_sd_m, 0.04);
    EXPECT_TRUE(played.play(false, 0.1, 30).empty());
}

TEST(VisitorReader, IgnoresPeopleWhoDoNotMoveForAMinute) {
    VisitorReader reader(set_up(), free_of_charge);
    Played played(reader);
    static_cast<void>(played.play(false, 1.5, 5));
    EXPECT_EQ(played.play(true, 50.0, 5).size(), 1U);
    EXPECT_TRUE(played.play(true, 12.0, 5).empty());
    EXPECT_EQ(played.play(false, 1.0, 5).size(), 1U); // the place of the person has a different background
                                                      // now
    static_cast<void>(played.play(false, 65.0, 5));
    EXPECT_EQ(played.play(true, 1.0, 5).size(), 1U);
}

/// Each frame takes 20 ms of CPU time: at 100 frames per second it reads one of twenty.
TEST(VisitorReader, TakesNoMoreThanATenthOfACore) {
    double busy_s = 0.0;
    VisitorReader reader(set_up(), [&busy_s] { return busy_s += 0.02; });
    for (int k = 1; k <= 100; ++k) {
        static_cast<void>(reader.read({MonotonicTime(milliseconds(10 * k)), 1, 0, 0, {}}));
    }
    EXPECT_EQ(reader.counts().looked_at, 5U);
    EXPECT_EQ(reader.counts().skipped, 95U);
}

TEST(VisitorTracker, PassesHeadsFromTheCameraThreadAndReportsAWrongShape) {
    VisitorTracker tracker(set_up());
    std::vector<tracking::SeenHead> heads;
    std::jthread([&tracker] {
        camera::CameraFrame nobody = frame_at(milliseconds(0), false, 1);
        camera::CameraFrame there = frame_at(milliseconds(0), true, 2);
        for (int k = 1; k <= 30; ++k) {
            camera::CameraFrame& frame = k <= 15 ? nobody : there;
            frame.time = MonotonicTime(milliseconds(100 * k));
            tracker.use(frame);
        }
    }).join();
    tracker.poll(MonotonicTime(milliseconds(2500)), heads);
    ASSERT_FALSE(heads.empty());
    EXPECT_LE(heads.back().time, MonotonicTime(milliseconds(2500)));
    EXPECT_EQ(heads.front().person, heads.back().person);
    EXPECT_EQ(tracker.trouble(), "");
    camera::CameraFrame frame = frame_at(milliseconds(9000), false, 1);
    frame.width = 480;
    tracker.use(frame);
    EXPECT_NE(tracker.trouble().find("another aspect ratio"), std::string_view::npos);
}

/// The whole chain: a person comes, walks in and stands, under a changing picture.
TEST(VisitorRun, TurnsThePictureToAnArrivingVisitor) {
    const simulators::Visit visit = simulators::run_visit({}, 5.0, 3);
    double worst_mm = 0.0;
    for (const simulators::VisitMoment& moment : visit.moments) {
        EXPECT_FALSE(moment.seen && !moment.was_there) << moment.t_s;
        if (moment.is_there) {
            ASSERT_TRUE(moment.seen) << moment.t_s;
            for (const double mm :
                 simulators::picture_errors_mm(visit.prop_m, moment.eye_m, moment.shown_eye_m)) {
                worst_mm = std::max(worst_mm, mm);
            }
        }
    }
    EXPECT_GT(worst_mm, 0.0);
    EXPECT_LT(worst_mm, 6.0);
}

/// The example that the page gives to technicians is accepted and equals the measured camera.
TEST(VisitorSettings, ExampleOfThePageEqualsTheCamera) {
    const std::string page = text_of(source_dir() + "/docs/visitor_eye.md");
    const std::size_t begin = page.find("```toml\n") + 8;
    const Result<settings::CheckedSettings> settings =
        settings::parse_settings(page.substr(begin, page.find("```", begin) - begin), "kiosk.toml");
    ASSERT_TRUE(settings) << settings.error().message;
    const settings::CameraSettings& camera = (*settings)->camera;
    EXPECT_TRUE(camera.visitor);
    const geometry::RigidTransform measured = simulators::WatchingCamera().table_from_camera();
    EXPECT_LT(glm::distance(camera.table_from_camera.translation, measured.translation), 1e-6);
    EXPECT_LT(glm::distance(camera.table_from_camera.direction({1, 2, 3}), measured.direction({1, 2, 3})),
              1e-3);
}

} // namespace
} // namespace frustumscreen::visitor
