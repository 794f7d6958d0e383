// A viewfinder shows the mean of a turned frame, and holds nothing of it but while it is wanted.

#include "tests/base/comes_true.h"
#include "tests/show/viewfinder_frames.h"

#include <numbers>

namespace frustumscreen::show {
namespace {

using namespace viewfinder_frames;

Grey turned_clockwise(const Grey& picture) {
    Grey turned(picture.height, picture.width);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            turned.at(picture.height - 1 - y, x) = picture.at(x, y);
        }
    }
    return turned;
}

TEST(Viewfinder, ShowsTheMeanOfEachSquareOfTheTurnedFrame) {
    struct Case {
        glm::ivec2 frame, area_px;
        int by;
    };
    for (const Case& at : {Case{{60, 40}, {80, 60}, 1}, Case{{161, 83}, {80, 60}, 3},
                           Case{{640, 480}, {320, 240}, 2}, Case{{1280, 720}, {320, 240}, 4}}) {
        const camera::CameraFrame frame = frame_of(at.frame.x, at.frame.y, 7);
        Viewfinder viewfinder(at.area_px, 0);
        image::Image8 shown(at.area_px.x, at.area_px.y, glm::u8vec4(9));
        viewfinder.want(true);
        viewfinder.use(frame);
        ASSERT_TRUE(viewfinder.take(shown));
        Grey picture(at.frame.x, at.frame.y);
        picture.texels = frame.luma;
        expect_mean_of(picture, at.by, shown);
        EXPECT_FALSE(viewfinder.take(shown)) << "each once";
    }
}

TEST(Viewfinder, TurnsTheFrameClockwiseByQuarters) {
    const camera::CameraFrame frame = frame_of(90, 50, 3);
    Grey turned(90, 50);
    turned.texels = frame.luma;
    for (int turns = 0; turns < 4; ++turns) {
        Viewfinder viewfinder({90, 90}, turns);
        image::Image8 shown(90, 90);
        viewfinder.want(true);
        viewfinder.use(frame);
        ASSERT_TRUE(viewfinder.take(shown));
        expect_mean_of(turned, 1, shown);
        turned = turned_clockwise(turned);
    }
}

/// A camera and a projector above the table, each turned about the vertical by quarters; a lamp lies at the far side.
TEST(Viewfinder, IsUprightForAnyoneAtTheFrontOfTheTable) {
    constexpr int side = 60;
    for (int camera = 0; camera < 4; ++camera) {
        for (int projector = 0; projector < 4; ++projector) {
            const auto hung = [](int quarters) {
                const double angle = 0.5 * std::numbers::pi * quarters + 0.1;
                return geometry::RigidTransform{
                    glm::angleAxis(angle, glm::dvec3(0, 0, 1)) * glm::dquat(0, 1, 0, 0), {0.0, 0.0, 1.0}};
            };
            settings::Settings settings;
            settings.projector.pinhole = {width, height, 300.0, 300.0, width / 2.0, height / 2.0};
            settings.projector.table_from_projector = hung(projector);
            settings.camera.pinhole = {side, side, 60.0, 60.0, side / 2.0, side / 2.0};
            settings.camera.table_from_camera = hung(camera);
            // The far side in the two pictures, by hand: at the top if neither is turned.
            const auto seen_at = [](int quarters) {
                const double angle = 0.5 * std::numbers::pi * quarters + 0.1;
                return glm::dvec2(std::sin(angle), -std::cos(angle));
            };
            camera::CameraFrame frame{MonotonicTime{}, 1, side, side,
                                      std::vector<std::uint8_t>(side * side, 10)};
            const glm::ivec2 lamp(glm::dvec2(side / 2.0) + 20.0 * seen_at(camera));
            frame.luma[static_cast<std::size_t>(lamp.y * side + lamp.x)] = 250;
            Viewfinder viewfinder(settings);
            image::Image8 shown(area_px.x, area_px.y);
            viewfinder.want(true);
            viewfinder.use(frame);
            ASSERT_TRUE(viewfinder.take(shown));
            const auto brightest = std::max_element(shown.texels.begin(), shown.texels.end(),
                                                    [](auto& a, auto& b) { return a.r < b.r; });
            const glm::dvec2 middle(area_px.x / 2.0, area_px.y - side / 2.0);
            const auto index = static_cast<int>(brightest - shown.texels.begin());
            const glm::dvec2 at = glm::dvec2(index % area_px.x, index / area_px.x) + 0.5 - middle;
            EXPECT_GT(glm::dot(glm::normalize(at), seen_at(projector)), 0.9) << camera << ' ' << projector;
        }
    }
}

TEST(Viewfinder, HoldsAFrameOnlyWhileRequested) {
    const camera::CameraFrame frame = frame_of(40, 30, 5);
    Viewfinder viewfinder(area_px, 0);
    image::Image8 shown(area_px.x, area_px.y);
    viewfinder.use(frame);
    EXPECT_FALSE(holds(viewfinder, frame));
    EXPECT_FALSE(viewfinder.take(shown));
    viewfinder.want(false);
    viewfinder.use(frame);
    EXPECT_FALSE(holds(viewfinder, frame));
    viewfinder.want(true);
    viewfinder.use(frame);
    EXPECT_TRUE(holds(viewfinder, frame));
    ASSERT_TRUE(viewfinder.take(shown));
    EXPECT_TRUE(holds(viewfinder, frame));
    viewfinder.want(false);
    EXPECT_FALSE(holds(viewfinder, frame));
    viewfinder.use(frame);
    EXPECT_FALSE(holds(viewfinder, frame));
    ASSERT_TRUE(viewfinder.take(shown));
    EXPECT_TRUE(std::all_of(shown.texels.begin(), shown.texels.end(),
                            [](const glm::u8vec4& code) { return code == glm::u8vec4(0, 0, 0, 255); }));
}

TEST(Viewfinder, LeavesNoFrameWhenStoppedDuringAWrite) {
    const camera::CameraFrame frame = frame_of(320, 240, 5);
    Viewfinder viewfinder({320, 240}, 1);
    image::Image8 shown(320, 240);
    std::jthread camera([&](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
            viewfinder.use(frame);
        }
    });
    int taken = 0;
    int calls = 0;
    EXPECT_TRUE(comes_true([&] {
        viewfinder.want(++calls % 4 != 3);
        taken += viewfinder.take(shown) ? 1 : 0;
        return taken == 20;
    }));
    // The call `want(false)` comes while the camera's thread writes: each later call tries again.
    for (int k = 0; k < 1000; ++k) {
        viewfinder.want(false);
        std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    camera.request_stop();
    camera.join();
    viewfinder.want(false); // the camera may have been writing at each call
    const auto* const begin = reinterpret_cast<const std::uint8_t*>(&viewfinder);
    EXPECT_LT(std::count_if(begin, begin + sizeof(viewfinder), [](std::uint8_t byte) { return byte != 0; }),
              100)
        << "of 76 800 bytes of a frame that has no zero";
}

} // namespace
} // namespace frustumscreen::show
