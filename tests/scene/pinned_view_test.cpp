// A pinned view: for the eye that pins, the window shows what the prop showed; the world is behind the window and fits it.

#include "app/scene/pinned_view.h"
#include "tests/render/counted_new.h"
#include "tests/render/ring_relief.h"
#include "tests/render/synthetic_pack.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace frustumscreen::scene {
namespace {

const glm::dvec3 up(0.0, 0.0, 1.0);

struct Drawn {
    PinRequest request;
    PinnedView view;
    glm::dmat4 table_from_prop{1.0}; ///< through the window

    explicit Drawn(const PinRequest& asked)
        : request(asked), view(pin_view(asked).value()),
          table_from_prop(view.table_from_window.matrix() * view.window_from_prop) {}
    [[nodiscard]] glm::dvec3 behind(const glm::dvec3& in_prop) const {
        return glm::dvec3(table_from_prop * glm::dvec4(in_prop, 1.0));
    }
    [[nodiscard]] glm::dvec3 middle() const { return behind(request.world.middle); }
    [[nodiscard]] double radius() const { return view.scale * request.world.radius; }
};

PinRequest any_request(std::mt19937& random) {
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    PinRequest request;
    request.table_from_prop = {glm::angleAxis(std::numbers::pi * u(random), up),
                               {0.2 * u(random), 0.15 * u(random), 0.0}};
    request.prop_middle = {0.0, 0.0, 0.06};
    request.eye_m = {0.7 * u(random), 0.6 * u(random), 0.5 + 0.3 * u(random)};
    request.world = {{0.0, 0.0, 0.05 + 0.01 * u(random)}, 0.05 + 0.02 * u(random)};
    request.place = {.middle_m = {0.3 * u(random), 0.2 * u(random)},
                     .yaw_rad = std::numbers::pi * u(random),
                     .width_m = 0.12 + 0.05 * u(random),
                     .depth_m = 0.12 + 0.05 * u(random)};
    return request;
}

/// Points of both balls lie in it, and it touches each of them on the far side.
TEST(WorldBall, UnionOfTwoIsTheSmallest) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    for (int k = 0; k < 500; ++k) {
        const WorldBall a{{u(random), u(random), u(random)}, 0.5 + 0.45 * u(random)};
        const WorldBall b{{u(random), u(random), u(random)}, 0.5 + 0.45 * u(random)};
        const WorldBall both = united(a, b);
        double farthest = 0.0;
        for (const WorldBall& ball : {a, b}) {
            farthest = std::max(farthest, glm::distance(both.middle, ball.middle) + ball.radius);
        }
        EXPECT_NEAR(farthest, both.radius, 1e-12);
        const double span = glm::distance(a.middle, b.middle) + a.radius + b.radius; // the longest chord
        EXPECT_NEAR(both.radius, std::max({a.radius, b.radius, 0.5 * span}), 1e-12);
    }
}

TEST(PinnedView, RepeatedPinIsEqualAndAllocatesNothing) {
    std::mt19937 random(12);
    PinnedView view = pin_view(any_request(random)).value();
    for (int k = 0; k < 50; ++k) {
        const PinRequest request = any_request(random);
        const long before = synthetic::allocations_so_far();
        const bool pinned = pin_view(request, view);
        const long after = synthetic::allocations_so_far();
        if (synthetic::allocations_are_counted) {
            EXPECT_EQ(after, before);
        }
        ASSERT_TRUE(pinned);
        const PinnedView fresh = pin_view(request).value();
        EXPECT_EQ(view.window_from_prop, fresh.window_from_prop);
        EXPECT_EQ(view.surface.corners, fresh.surface.corners);
        ASSERT_EQ(view.surface.faces.size(), 1U);
        EXPECT_EQ(view.surface.faces[0].corners.size(), 4U);
    }
}

/// Through the lens: the artifact turns about its middle and keeps its place; its size is a factor.
TEST(PinnedView, TurnAndZoomMatchExactArithmetic) {
    std::mt19937 random(13);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    for (int k = 0; k < 100; ++k) {
        PinRequest request = any_request(random);
        const Drawn plain(request);
        const double turn = 3.0 * u(random);
        request.turn = glm::angleAxis(turn, up);
        const Drawn turned(request);
        EXPECT_LT(glm::distance(turned.middle(), plain.middle()), 1e-12);
        const glm::dvec3 to(0.03 * u(random), 0.03 * u(random), 0.03 * u(random));
        const glm::dvec3 by(std::cos(turn) * to.x - std::sin(turn) * to.y,
                            std::sin(turn) * to.x + std::cos(turn) * to.y, to.z);
        EXPECT_LT(
            glm::distance(turned.behind(request.world.middle + to), plain.behind(request.world.middle + by)),
            1e-12);
        request.zoom = 1.5 + u(random);
        const Drawn zoomed(request);
        EXPECT_NEAR(zoomed.radius() / plain.radius(), request.zoom, 1e-12);
        const glm::dvec3 eye = request.eye_m;
        EXPECT_NEAR(glm::dot(glm::normalize(zoomed.middle() - eye), glm::normalize(plain.middle() - eye)),
                    1.0, 1e-12)
            << "on the same ray";
    }
}

TEST(PinnedView, IsASimilarityTransform) {
    std::mt19937 random(1);
    for (int k = 0; k < 200; ++k) {
        const Drawn drawn(any_request(random));
        const glm::dmat3 linear(drawn.view.window_from_prop);
        for (int a = 0; a < 3; ++a) {
            EXPECT_NEAR(glm::length(linear[a]) / drawn.view.scale, 1.0, 1e-12);
            EXPECT_NEAR(glm::dot(linear[a], linear[(a + 1) % 3]), 0.0, 1e-12);
        }
        EXPECT_GT(glm::determinant(linear), 0.0);
    }
}

/// An upright line of the prop stays upright for the eye, at the same angle to the eye's ray.
TEST(PinnedView, KeepsTheRoll) {
    std::mt19937 random(2);
    for (int k = 0; k < 200; ++k) {
        const Drawn drawn(any_request(random));
        const PinRequest& request = drawn.request;
        const auto seen = [&](const glm::dvec3& at, const glm::dvec3& foot, const glm::dvec3& head) {
            const glm::dvec3 forward = glm::normalize(at - request.eye_m);
            const glm::dvec3 right = glm::normalize(glm::cross(forward, up));
            const glm::dmat3 from_camera(right, glm::cross(right, forward), forward);
            return glm::transpose(from_camera) * glm::normalize(head - foot);
        };
        const glm::dvec3 head = request.prop_middle + up;
        const glm::dvec3 before =
            seen(request.table_from_prop.point(request.prop_middle),
                 request.table_from_prop.point(request.prop_middle), request.table_from_prop.point(head));
        const glm::dvec3 after =
            seen({request.place.middle_m, 0.0}, drawn.behind(request.prop_middle), drawn.behind(head));
        EXPECT_NEAR(before.x, 0.0, 1e-12);
        EXPECT_LT(glm::distance(before, after), 1e-9) << k;
    }
}

TEST(PinnedView, LiesJustBehindTheWindow) {
    std::mt19937 random(3);
    for (int k = 0; k < 500; ++k) {
        const Drawn drawn(any_request(random));
        const double nearest = drawn.middle().z + drawn.radius();
        EXPECT_LT(nearest, 0.0);
        EXPECT_GT(nearest, -1e-3);
    }
}

/// Every ray that touches the world's ball goes through the window; some come near to its edge.
TEST(PinnedView, FitsTheWindow) {
    std::mt19937 random(4);
    for (int k = 0; k < 300; ++k) {
        const Drawn drawn(any_request(random));
        const glm::dvec3 eye = drawn.view.table_from_window.inverse().point(drawn.request.eye_m);
        const glm::dvec3 middle = drawn.view.table_from_window.inverse().point(drawn.middle());
        const glm::dvec3 axis = glm::normalize(middle - eye);
        const glm::dvec3 side = glm::normalize(glm::cross(axis, glm::dvec3(0.3, 0.5, 0.8)));
        const double angle = std::asin(drawn.radius() / glm::distance(middle, eye));
        double farthest = 0.0; // 1: on the edge
        for (int step = 0; step < 360; ++step) {
            const glm::dvec3 ray = glm::angleAxis(glm::radians(1.0 * step), axis) *
                                   (std::cos(angle) * axis + std::sin(angle) * side);
            const glm::dvec3 at = eye - eye.z / ray.z * ray;
            farthest = std::fmax(farthest, std::fmax(std::fabs(at.x) / (0.5 * drawn.request.place.width_m),
                                                     std::fabs(at.y) / (0.5 * drawn.request.place.depth_m)));
        }
        EXPECT_LT(farthest, 1.0) << k;
        EXPECT_GT(farthest, 0.75) << k;
    }
}

/// A prop that is pinned where it stands, by an eye that looks along the ray through both middles, is not turned.
TEST(PinnedView, IsNotTurnedAtThePropsOwnPlace) {
    PinRequest request;
    request.prop_middle = {0.0, 0.0, 0.06};
    request.eye_m = {0.0, -0.5, 0.4};
    const double share = request.eye_m.z / (request.eye_m.z - request.prop_middle.z);
    const glm::dvec3 meets = request.eye_m + share * (request.prop_middle - request.eye_m);
    request.world = {request.prop_middle, 0.05};
    request.place.middle_m = glm::dvec2(meets);
    const Drawn drawn(request);
    for (int a = 0; a < 3; ++a) {
        glm::dvec3 axis(0.0);
        axis[a] = 1.0;
        EXPECT_LT(glm::distance(glm::dvec3(drawn.view.window_from_prop[a]) / drawn.view.scale, axis), 1e-12);
    }
}

TEST(PinnedView, AppliesTurnAndZoomTogether) {
    std::mt19937 random(5);
    const PinRequest request = any_request(random);
    const Drawn plain(request);
    PinRequest other = request;
    other.zoom = 1.5;
    other.turn = glm::angleAxis(1.0, up);
    const Drawn drawn(other);
    EXPECT_NEAR(drawn.view.scale / plain.view.scale, 1.5, 1e-12);
    EXPECT_LT(drawn.middle().z + drawn.radius(), 0.0);
    const glm::dvec3 offset(0.01, 0.0, 0.0);
    const glm::dvec3 turned = drawn.behind(other.world.middle + offset) - drawn.middle();
    const glm::dvec3 expected =
        1.5 * (plain.behind(request.world.middle + other.turn * offset) - plain.middle());
    EXPECT_LT(glm::distance(turned, expected), 1e-12);
}

TEST(PinnedView, AcceptsExtremeEyesAndRejectsInvalidRequests) {
    std::mt19937 random(6);
    PinRequest request = any_request(random);
    request.eye_m = {request.place.middle_m, 0.6}; // straight above the window
    EXPECT_TRUE(pin_view(request));
    request.eye_m = request.table_from_prop.point({0.0, 0.0, 0.7}); // straight above the prop
    EXPECT_TRUE(pin_view(request));
    request.eye_m = {0.3, 0.3, 1e-6};
    EXPECT_TRUE(pin_view(request));
    for (const double z : {0.0, -0.2, std::numeric_limits<double>::quiet_NaN()}) {
        request.eye_m = {0.3, 0.3, z};
        EXPECT_FALSE(pin_view(request)) << z;
    }
    request = any_request(random);
    request.world.radius = 0.0;
    EXPECT_FALSE(pin_view(request));
    request = any_request(random);
    request.place.middle_m.x = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(pin_view(request));
}

TEST(WorldBall, HoldsEveryTriangle) {
    const pack::Pack pack = synthetic::rings(96, 48);
    PlacedLevel mesh = placed(pack, 0, 0.1);
    mesh.prop_from_placed[3] = glm::dvec4(0.02, 0.01, 0.0, 1.0);
    const Part part{mesh, std::nullopt};
    const WorldBall ball = ball_around(std::span(&part, 1)).value();
    double farthest = 0.0;
    for (const std::uint32_t index : mesh.triangles->indices) {
        const glm::dvec3 at(mesh.prop_from_box() *
                            glm::dvec4(glm::dvec3(mesh.triangles->positions[index]), 1.0));
        farthest = std::fmax(farthest, glm::distance(at, ball.middle));
    }
    EXPECT_LE(farthest, ball.radius);
    EXPECT_GT(farthest, 0.9 * ball.radius);
    const Part nothing{};
    EXPECT_FALSE(ball_around(std::span(&nothing, 1)));
}

TEST(WorldBall, IsTheSameForAReliefAndItsMesh) {
    const pack::Pack pack = synthetic::rings();
    const std::array parts{
        Part{placed(pack, 0, 0.1), std::nullopt},
        Part{placed(pack, synthetic::relief_of(pack, 128), 0.1, Drawable{}), std::nullopt}};
    const WorldBall mesh = ball_around(std::span(parts).first(1)).value();
    const WorldBall relief = ball_around(std::span(parts).last(1)).value();
    EXPECT_LT(glm::distance(mesh.middle, relief.middle), 0.005);
    EXPECT_NEAR(relief.radius, mesh.radius, 0.01);
}

TEST(WorldBehindAWindow, ShowsOnAllFaces) {
    const pack::Pack pack = synthetic::rings();
    PlacedLevel level = placed(pack, 0, 0.1);
    level.faces = 4;
    const Part part{level, std::nullopt};
    std::vector<Part> moved;
    move_behind(glm::dmat4(2.0), std::span(&part, 1), moved);
    ASSERT_EQ(moved.size(), 1U);
    EXPECT_EQ(moved[0].level.faces, ~std::uint32_t{0});
    EXPECT_EQ(moved[0].level.prop_from_placed, glm::dmat4(2.0));
}

} // namespace
} // namespace frustumscreen::scene
