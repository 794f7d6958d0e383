#include "app/settings/looking_at.h"
#include "app/settings/settings.h"
#include "app/tags/tag_tracker.h"
#include "app/tracking/pose_math.h"
#include "tests/base/text_of.h"
#include "tests/folders.h"
#include "tests/simulators/tags/skirt.h"
#include "tests/simulators/tags/tag_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <thread>

namespace frustumscreen::tags {
namespace {

using std::chrono::milliseconds;

const geometry::RigidTransform standing{tracking::rotation_of({0.0, 0.0, 0.2}), {0.04, -0.03, 0.0}};

simulators::SceneCamera above() {
    simulators::SceneCamera camera;
    camera.table_from_camera = *settings::looking_at({0.1, -0.2, 1.25}, {0.0, 0.0, 0.0}, 0.0);
    return camera;
}

TagSetUp set_up() {
    return {above().pinhole, above().table_from_camera, simulators::tags_of({})};
}

camera::CameraFrame frame_at(milliseconds time) {
    static const std::vector<std::uint8_t> picture =
        simulators::TagScene(geometry::make_frustum(geometry::shipped_frustum), simulators::tags_of({}),
                             above(), {})
            .picture([](double) { return standing; }, 1);
    return {MonotonicTime(time), 1, 1280, 720, picture};
}

TEST(TagReader, AFrameGivesThePoseOnTheTable) {
    TagReader reader(set_up());
    const std::optional<tracking::UncertainPose> pose = reader.read(frame_at(milliseconds(500)));
    ASSERT_TRUE(pose);
    EXPECT_EQ(pose->time, MonotonicTime(milliseconds(500)));
    EXPECT_LT(tracking::slip_m(tracking::step_between(standing, pose->table_from_prop), 0.0775), 0.001);
    EXPECT_EQ(reader.counts().posed, 1U);
}

/// A tag in the air above the prop, as on a lamp that points at it: the lamp's pose comes from the same frame, and the prop's
/// is as without it.
TEST(TagReader, GivesThePoseOfALamp) {
    constexpr int id = 586;
    const geometry::RigidTransform torch_from_tag{
        tracking::rotation_of({0.5 * 3.14159265358979323846, 0.0, 0.0}), {0.0, -0.03, -0.05}};
    // The tag looks up and leans by 40 degrees, beside the prop.
    const geometry::RigidTransform prop_from_tag{tracking::rotation_of({0.7, 0.2, 0.0}), {0.19, -0.16, 0.25}};
    std::vector<PropTag> all = simulators::tags_of({});
    all.push_back({id, 0.06, prop_from_tag});
    const simulators::TagScene scene(geometry::make_frustum(geometry::shipped_frustum), all, above(), {});
    const std::vector<std::uint8_t> picture = scene.picture([](double) { return standing; }, 1);
    const camera::CameraFrame frame{MonotonicTime(milliseconds(500)), 1, 1280, 720, picture};
    TagSetUp with = set_up();
    with.lamp = PropTag{id, 0.06, torch_from_tag};
    TagReader reader(with);
    const std::optional<tracking::UncertainPose> prop = reader.read(frame);
    ASSERT_TRUE(prop);
    EXPECT_LT(tracking::slip_m(tracking::step_between(standing, prop->table_from_prop), 0.0775), 0.001);
    ASSERT_TRUE(reader.lamp());
    const geometry::RigidTransform truth = standing * prop_from_tag * torch_from_tag.inverse();
    const tracking::PoseStep off = tracking::step_between(truth, reader.lamp()->table_from_prop);
    EXPECT_LT(glm::length(off.shift_m), 3.0 * reader.lamp()->place_sd_m + 1e-3);
    EXPECT_LT(glm::length(off.turn_rad), 0.1);
    EXPECT_EQ(reader.lamp()->time, MonotonicTime(milliseconds(500)));

    TagReader without(set_up());
    ASSERT_TRUE(without.read(frame));
    EXPECT_FALSE(without.lamp());
    ASSERT_TRUE(reader.read(frame_at(milliseconds(700)))); // a frame without it
    EXPECT_FALSE(reader.lamp());
}

/// Slid at 0.3 m/s in front of a shutter that takes 25 ms from the first row to the last: after four frames
/// each pose is the prop's at the pose's time, which is the time of its tags' rows. The frame's time is its
/// middle row's.
TEST(TagReader, CorrectsTheSkewOfARollingShutter) {
    const auto prop = [](double t_s) {
        return geometry::RigidTransform{standing.rotation,
                                        standing.translation + glm::dvec3(0.3 * t_s, 0.0, 0.0)};
    };
    simulators::SceneCamera camera = above();
    camera.rolling_ms = 25.0;
    const simulators::TagScene scene(geometry::make_frustum(geometry::shipped_frustum),
                                     simulators::tags_of({}), camera, {});
    TagSetUp known = set_up();
    known.readout_s = 0.025;
    const MonotonicTime begin(std::chrono::seconds(1));
    TagReader reader(known, [] { return 0.0; });
    TagReader unknowing(set_up(), [] { return 0.0; });
    tracking::PoseStep off, skewed;
    for (int k = 0; k < 4; ++k) {
        const double first_row_s = k / 30.0;
        const auto nanoseconds = [](double s) { return Nanoseconds(std::llround(1e9 * s)); };
        const camera::CameraFrame frame{
            begin + nanoseconds(first_row_s + 0.5 * known.readout_s), 1, 1280, 720,
            scene.picture([&](double t_s) { return prop(first_row_s + t_s); }, 1)};
        const auto off_truth = [&](const std::optional<tracking::UncertainPose>& pose) {
            const double exposed_s = to_seconds(pose->time - begin) + 0.5e-3 * camera.exposure_ms;
            return tracking::step_between(prop(exposed_s), pose->table_from_prop);
        };
        const auto pose = reader.read(frame);
        const auto without = unknowing.read(frame);
        ASSERT_TRUE(pose && without);
        EXPECT_NE(pose->time, frame.time);
        off = off_truth(pose);
        skewed = off_truth(without);
    }
    EXPECT_LT(glm::length(off.shift_m), 0.0012);
    EXPECT_LT(glm::length(off.turn_rad), 0.2 * glm::length(skewed.turn_rad));
    EXPECT_GT(glm::length(skewed.turn_rad), 0.02);
}

/// Each frame takes 20 ms of CPU time: at 100 frames per second it reads one of eight.
TEST(TagReader, TakesNoMoreThanAQuarterOfACore) {
    double busy_s = 0.0;
    TagReader reader(set_up(), [&busy_s] { return busy_s += 0.02; });
    for (int k = 1; k <= 80; ++k) {
        static_cast<void>(reader.read({MonotonicTime(milliseconds(10 * k)), 1, 0, 0, {}}));
    }
    EXPECT_EQ(reader.counts().looked_at, 10U);
    EXPECT_EQ(reader.counts().skipped, 70U);
    EXPECT_EQ(reader.counts().at_half_size, 9U); // from the second on
}

TEST(TagReader, SearchesTheWholePictureWhileThatIsCheap) {
    double busy_s = 0.0;
    double takes_s = 0.005;
    TagReader reader(set_up(), [&] { return busy_s += takes_s; });
    auto look = [&reader, k = 0](int frames) mutable {
        for (const int end = k + frames; k < end; ++k) {
            static_cast<void>(reader.read({MonotonicTime(std::chrono::seconds(k + 1)), 1, 0, 0, {}}));
        }
    };
    look(50);
    EXPECT_EQ(reader.counts().at_half_size, 0U);
    takes_s = 0.01;
    look(1);
    takes_s = 0.002;
    look(150); // it tries full size again
    EXPECT_EQ(reader.counts().at_half_size, 100U);
}

/// Tags of 18 pixels, on a processor that takes 13 ms for a whole picture: at half size none is found, so
/// only two frames in 202 may be lost, not a hundred in 101.
TEST(TagReader, KeepsFullSizeWhenHalfSizeFindsNoTags) {
    simulators::SceneCamera small = above();
    small.pinhole = small.pinhole.scaled_to(640, 360);
    const simulators::TagScene scene(geometry::make_frustum(geometry::shipped_frustum),
                                     simulators::tags_of({}), small, {});
    const std::vector<std::uint8_t> picture = scene.picture([](double) { return standing; }, 1);
    std::vector<FoundTag> at_half;
    TagDetector({.decimate = 2.0}).find(picture, 640, 360, at_half);
    ASSERT_FALSE(pose_from_tags(at_half, simulators::tags_of({}), small.pinhole, usual_corner_sd_px))
        << "this proves nothing";

    double busy_s = 0.0;
    TagReader reader({small.pinhole, small.table_from_camera, simulators::tags_of({})},
                     [&busy_s] { return busy_s += 0.013; });
    for (int k = 1; k <= 202; ++k) {
        static_cast<void>(reader.read({MonotonicTime(milliseconds(100 * k)), 1, 640, 360, picture}));
    }
    EXPECT_EQ(reader.counts().looked_at, 202U);
    EXPECT_EQ(reader.counts().at_half_size, 2U);
    EXPECT_EQ(reader.counts().posed, 200U);
}

TEST(TagReader, RejectsFramesOfAnotherAspectRatio) {
    TagReader reader(set_up());
    camera::CameraFrame frame = frame_at(milliseconds(1));
    frame.width = 960;
    frame.luma.resize(960 * 720);
    EXPECT_FALSE(reader.read(frame));
    EXPECT_EQ(reader.counts().misshapen, 1U);
}

TEST(TagTracker, PassesPosesFromTheCameraThread) {
    TagTracker tracker(set_up());
    std::jthread([&tracker] {
        for (int k = 1; k <= 3; ++k) {
            tracker.use(frame_at(milliseconds(1000 * k)));
        }
    }).join();
    std::vector<tracking::UncertainPose> poses;
    tracker.poll(MonotonicTime(std::chrono::hours(1)), poses);
    ASSERT_EQ(poses.size(), 3U);
    EXPECT_LT(poses[0].time, poses[1].time);
    EXPECT_LT(tracking::slip_m(tracking::step_between(standing, poses[1].table_from_prop), 0.0775), 0.001);
    EXPECT_EQ(tracker.trouble(), "");
}

TEST(TagSettings, PlaceTagsLikeTheSkirt) {
    for (const double slope : {0.0, 35.0}) {
        for (const PropTag& tag : simulators::tags_of({.slope_deg = slope})) {
            const int side = tag.id / 2;
            const settings::TagSettings written{tag.id, tag.size_m, tag.prop_from_tag.translation,
                                                90.0 * side, slope};
            const tracking::PoseStep off =
                tracking::step_between(tag.prop_from_tag, settings::prop_from_tag(written));
            EXPECT_LT(glm::length(off.shift_m) + glm::length(off.turn_rad), 1e-12);
        }
    }
    // An upright tag at the front edge faces the visitor, its top up.
    const geometry::RigidTransform upright =
        settings::prop_from_tag({0, 0.03, {0.0, -0.15, 0.02}, 0.0, 90.0});
    EXPECT_LT(glm::distance(upright.direction({0, 0, 1}), glm::dvec3(0, -1, 0)), 1e-12);
    EXPECT_LT(glm::distance(upright.direction({0, 1, 0}), glm::dvec3(0, 0, 1)), 1e-12);
}

/// The example that the page gives to technicians is accepted and equals the measured skirt.
TEST(TagSettings, ExampleOfThePageEqualsTheSkirt) {
    const std::string page = text_of(source_dir() + "/docs/tags.md");
    const std::size_t begin = page.find("```toml\n") + 8;
    const Result<settings::CheckedSettings> settings =
        settings::parse_settings(page.substr(begin, page.find("```", begin) - begin), "kiosk.toml");
    ASSERT_TRUE(settings) << settings.error().message;
    const std::vector<PropTag> skirt = simulators::tags_of({});
    ASSERT_EQ((*settings)->camera.tag.size(), skirt.size());
    for (std::size_t k = 0; k < skirt.size(); ++k) {
        const settings::TagSettings& tag = (*settings)->camera.tag[k];
        const tracking::PoseStep off =
            tracking::step_between(skirt[k].prop_from_tag, settings::prop_from_tag(tag));
        EXPECT_LT(glm::length(off.shift_m) + glm::length(off.turn_rad), 1e-9) << k;
        EXPECT_EQ(tag.id, skirt[k].id);
        EXPECT_EQ(tag.size_m, skirt[k].size_m);
    }
    EXPECT_EQ((*settings)->camera.pinhole.fy, 1500.0);
    EXPECT_EQ((*settings)->camera.pinhole.cx, 640.0);
}

} // namespace
} // namespace frustumscreen::tags
