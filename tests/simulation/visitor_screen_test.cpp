// The screen in the visitor's view against plain arithmetic: a line through eye and pixel, a plane, a projection.
#include "app/simulation/visitor_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace frustumscreen::simulation {
namespace {

constexpr glm::ivec2 screen_px(320, 180);
constexpr glm::u8vec4 black(0, 0, 0, 255);

struct Pose {
    const char* name;
    std::array<glm::dvec3, 4> corners_m;
    glm::dvec3 eye_m;
};
/// Upright, leaning back, turned about the vertical.
const Pose poses[] = {
    {"upright",
     {{{-0.6, 0.4, 0.675}, {0.6, 0.4, 0.675}, {0.6, 0.4, 0.0}, {-0.6, 0.4, 0.0}}},
     {0.1, -1.0, 0.6}},
    {"leaning",
     {{{-0.6, 0.6, 0.64}, {0.6, 0.6, 0.64}, {0.6, 0.39, 0.0}, {-0.6, 0.39, 0.0}}},
     {-0.4, -0.9, 0.5}},
    {"turned", {{{-0.5, 0.5, 0.7}, {0.5, 0.3, 0.7}, {0.5, 0.3, 0.1}, {-0.5, 0.5, 0.1}}}, {0.3, -0.8, 0.4}}};

VisitorScene scene_of(const Pose& pose, image::Image8 picture) {
    VisitorScene scene{.projector = {1280, 800, 1920.0, 1920.0, 640.0, 400.0},
                       .table_from_projector = {glm::dquat(0.0, 1.0, 0.0, 0.0), {0.0, 0.0, 1.2}},
                       .prop = geometry::make_frustum({}),
                       .table_from_prop = {glm::angleAxis(0.4, glm::dvec3(0, 0, 1)), {0.02, -0.03, 0.0}},
                       .eye_m = pose.eye_m};
    scene.screen = VisitorScreen{.corners_m = pose.corners_m, .picture = std::move(picture)};
    return scene;
}

/// Where the camera sees a point, by its matrix alone.
glm::dvec2 seen_at(const VisitorCamera& camera, const glm::dvec3& point_m) {
    const glm::dvec4 in_camera = glm::inverse(camera.table_from_camera.matrix()) * glm::dvec4(point_m, 1.0);
    return {camera.pinhole.fx * in_camera.x / in_camera.z + camera.pinhole.cx,
            camera.pinhole.fy * in_camera.y / in_camera.z + camera.pinhole.cy};
}

/// The point of the panel that a pixel of its picture lights: opposite sides are parallel.
glm::dvec3 lit_point(const Pose& pose, const glm::dvec2& pixel) {
    const glm::dvec2 share = pixel / glm::dvec2(screen_px);
    return pose.corners_m[0] + share.x * (pose.corners_m[1] - pose.corners_m[0]) +
           share.y * (pose.corners_m[3] - pose.corners_m[0]);
}

const image::Image8 dark(1280, 800, black);

TEST(VisitorScreen, PixelsAppearWhereTheirRayToTheEyeMeetsThePicture) {
    std::size_t looked_at = 0;
    for (const Pose& pose : poses) {
        for (const glm::ivec2 dot : {glm::ivec2(40, 20), glm::ivec2(280, 24), glm::ivec2(30, 90)}) {
            image::Image8 picture(screen_px.x, screen_px.y, black);
            constexpr int half = 3;
            for (int y = -half; y <= half; ++y) {
                for (int x = -half; x <= half; ++x) {
                    picture.at(dot.x + x, dot.y + y) = glm::u8vec4(255, 255, 255, 255);
                }
            }
            const VisitorScene scene = scene_of(pose, picture);
            const VisitorCamera camera = whole_camera(scene, 800, 600);
            const image::Image8 view = visitor_view(scene, dark, camera, {.light = false});
            glm::dvec3 sum(0.0);
            for (int y = 0; y < view.height; ++y) {
                for (int x = 0; x < view.width; ++x) {
                    const double light = image::linear_from_srgb(view.at(x, y).r / 255.0);
                    sum += light * glm::dvec3(x + 0.5, y + 0.5, 1.0);
                }
            }
            ASSERT_GT(sum.z, 2.0) << pose.name;
            const glm::dvec2 found = glm::dvec2(sum) / sum.z;
            const glm::dvec2 expected = seen_at(camera, lit_point(pose, glm::dvec2(dot) + 0.5));
            EXPECT_LT(glm::distance(found, expected), 0.5)
                << pose.name << ", pixel " << dot.x << ", " << dot.y;
            ++looked_at;
        }
    }
    EXPECT_EQ(looked_at, 9U);
}

/// Between prop and screen there is neither a dark rim nor anything else.
TEST(VisitorScreen, HasNoOtherColourAtTheEdgeOfTheProp) {
    Pose pose = poses[0];
    pose.eye_m = {0.05, -0.8, 0.16}; // the prop's upper half is before the screen
    const VisitorScene scene =
        scene_of(pose, image::Image8(screen_px.x, screen_px.y, glm::u8vec4(0, 255, 0, 255)));
    const VisitorCamera camera = whole_camera(scene, 960, 720);
    const image::Image8 red(1280, 800, glm::u8vec4(255, 0, 0, 255));
    const image::Image8 view = visitor_view(scene, red, camera, exact_check());
    const geometry::RigidTransform prop_from_table = scene.table_from_prop.inverse();
    std::size_t on_prop = 0;
    std::size_t on_screen = 0;
    for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) {
            const glm::dvec3 ray = camera.table_from_camera.direction(camera.pinhole.ray({x + 0.5, y + 0.5}));
            const glm::dvec3 meets_plane = pose.eye_m + ray * ((0.4 - pose.eye_m.y) / ray.y);
            constexpr double rounding_m = 1e-9;
            if (std::abs(meets_plane.x) > 0.6 - rounding_m || meets_plane.z < rounding_m ||
                meets_plane.z > 0.675 - rounding_m) {
                continue; // beside the lit area; the table, below the eye, is before none of it
            }
            const glm::u8vec4& code = view.at(x, y);
            const bool screen = code == glm::u8vec4(0, 255, 0, 255);
            const bool prop =
                code == glm::u8vec4(255, 0, 0, 255) || code == black; // a face without light is black
            EXPECT_TRUE(screen || prop) << x << ", " << y;
            // The prop hides the screen, and nothing else does.
            geometry::PropHit hit;
            const bool meets = geometry::enter(scene.prop, prop_from_table.point(scene.eye_m),
                                               prop_from_table.direction(ray), hit);
            EXPECT_NE(meets, screen) << x << ", " << y;
            (screen ? on_screen : on_prop) += 1;
        }
    }
    EXPECT_GT(on_prop, 1000U);
    EXPECT_GT(on_screen, 20000U);
}

TEST(VisitorScreen, EmitsLightOnlyToTheFront) {
    const Pose& pose = poses[0];
    VisitorScene scene =
        scene_of(pose, image::Image8(screen_px.x, screen_px.y, glm::u8vec4(255, 255, 255, 255)));
    const VisitorCamera camera = whole_camera(scene, 640, 480);
    const glm::ivec2 middle = glm::ivec2(seen_at(camera, lit_point(pose, {160.0, 30.0})));
    const std::uint8_t white = image::srgb8_from_linear(scene.screen->white);
    for (const std::uint8_t code : {std::uint8_t{0}, std::uint8_t{255}}) { // whatever the projector does
        const image::Image8 view =
            visitor_view(scene, image::Image8(1280, 800, glm::u8vec4(code, code, code, 255)), camera);
        EXPECT_EQ(view.at(middle.x, middle.y), glm::u8vec4(white, white, white, 255));
    }
    // Its light falls on the table before it, more of it near the screen.
    const image::Image8 lit = visitor_view(scene, dark, camera);
    scene.screen->white = 0.0;
    const image::Image8 off = visitor_view(scene, dark, camera);
    const auto gained = [&](const glm::dvec3& place) {
        const glm::ivec2 at(seen_at(camera, place));
        return image::linear_from_srgb(lit.at(at.x, at.y).g / 255.0) -
               image::linear_from_srgb(off.at(at.x, at.y).g / 255.0);
    };
    EXPECT_GT(gained({0.3, 0.22, 0.0}), gained({0.3, 0.0, 0.0}));
    EXPECT_GT(gained({0.3, 0.0, 0.0}), 0.005);
    // From behind it is a dark board.
    scene.screen->white = 0.85;
    scene.eye_m = {0.0, 2.0, 0.5};
    const std::optional<ScreenHit> back = meet(*scene.screen, scene.eye_m, {0.0, -1.0, 0.0});
    ASSERT_TRUE(back);
    EXPECT_FALSE(back->shines);
    EXPECT_NEAR(back->t, 1.6, 1e-12);
}

TEST(WholeCamera, ShowsPropAndScreenWithoutRoll) {
    for (const Pose& pose : poses) {
        const VisitorScene scene = scene_of(pose, image::Image8(screen_px.x, screen_px.y, black));
        for (const glm::ivec2 size : {glm::ivec2(1280, 720), glm::ivec2(600, 900)}) {
            const VisitorCamera camera = whole_camera(scene, size.x, size.y);
            EXPECT_EQ(camera.table_from_camera.translation, pose.eye_m);
            EXPECT_NEAR(camera.table_from_camera.direction({1.0, 0.0, 0.0}).z, 0.0, 1e-12) << "no roll";
            std::vector<glm::dvec3> shown(pose.corners_m.begin(), pose.corners_m.end());
            for (const glm::dvec3& corner : scene.prop.corners) {
                shown.push_back(scene.table_from_prop.point(corner));
            }
            glm::dvec2 low(1e9);
            glm::dvec2 high(-1e9);
            for (const glm::dvec3& place : shown) {
                low = glm::min(low, seen_at(camera, place));
                high = glm::max(high, seen_at(camera, place));
            }
            EXPECT_TRUE(low.x >= 0.0 && low.y >= 0.0 && high.x <= size.x && high.y <= size.y) << pose.name;
            EXPECT_GT(std::max((high.x - low.x) / size.x, (high.y - low.y) / size.y), 0.75) << pose.name;
        }
    }
}

} // namespace
} // namespace frustumscreen::simulation
