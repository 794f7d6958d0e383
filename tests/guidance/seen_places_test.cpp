// The visibility of an artifact, and how much of it is lost, compared with rays from the eye.
#include "app/guidance/seen_places.h"
#include "guided_props.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace frustumscreen::guidance {
namespace {

/// A prop, and an artifact in it whose planes the ray cast uses.
struct Shown {
    GuidanceSetup setup;
    geometry::PropShape artifact;
};

Shown in_frustum() {
    return {frustum_setup(), geometry::make_frustum({0.10, 0.06, 0.14})};
}
Shown in_cube() {
    return {cube_setup(), geometry::make_frustum({0.05, 0.05, 0.09})};
}
/// An artifact that extends out of the prop at the top, which acts as a window on it.
Shown beyond_frustum() {
    return {frustum_setup(), geometry::make_frustum({0.12, 0.10, 0.16})};
}

Shown in_hexagon() {
    return {hexagon_setup(), geometry::make_frustum({0.07, 0.05, 0.11})};
}
Shown in_tetrahedron() {
    return {tetrahedron_setup(), geometry::make_frustum({0.05, 0.02, 0.05})};
}
Shown in_gem() {
    return {gem_setup(), geometry::make_frustum({0.08, 0.05, 0.08})};
}

/// The pixels of a pinhole at the eye through which the artifact would be seen, at places without light.
double traced_lost_px(const Shown& shown, const GuidedState& tracked_state) {
    const GuidanceSetup& setup = shown.setup;
    const geometry::RigidTransform prop_from_table = tracked_state.table_from_prop.inverse();
    const glm::dvec3 eye = prop_from_table.point(tracked_state.eye_m);
    const glm::dvec3 lens = prop_from_table.point(setup.table_from_projector.translation);
    const geometry::RigidTransform projector_from_prop =
        setup.table_from_projector.inverse() * tracked_state.table_from_prop;
    const glm::dvec3 forward = glm::normalize(setup.prop.middle - eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, prop_from_table.direction({0.0, 0.0, 1.0})));
    const glm::dvec3 down = glm::cross(forward, right);
    const FaceReader reader(setup);
    const std::uint32_t seen = reader.read(tracked_state).seen;
    const auto is_lit = [&](const glm::dvec3& place, const geometry::PropFace& face) {
        const glm::dvec3 p = projector_from_prop.point(place);
        const double u = setup.projector.fx * p.x / p.z + setup.projector.cx;
        const double v = setup.projector.fy * p.y / p.z + setup.projector.cy;
        const bool turned =
            std::all_of(face.corners.begin(), face.corners.end(), [&](const glm::dvec3& corner) {
                return face.plane.distance(lens) >= setup.min_sine_of_light * glm::distance(lens, corner);
            });
        return turned && p.z > 0.0 && u >= 0.0 && v >= 0.0 && u <= setup.projector.width &&
               v <= setup.projector.height;
    };
    constexpr int half = 700;
    constexpr int step = 5;
    int count = 0;
    for (int v = -half; v < half; v += step) {
        for (int u = -half; u < half; u += step) {
            const glm::dvec3 ray =
                forward + (right * (u + 0.5) + down * (v + 0.5)) / FaceReader::pixels_per_radian;
            geometry::PropHit window;
            geometry::PropHit hit;
            if (!geometry::intersect(setup.prop, eye, ray, window) ||
                !geometry::enter(shown.artifact, eye, ray, hit)) {
                continue;
            }
            const geometry::PropFace& face = setup.prop.faces[static_cast<std::size_t>(window.face)];
            const bool counts = (seen >> window.face & 1U) != 0 && !is_lit(eye + window.t * ray, face);
            count += counts ? 1 : 0;
        }
    }
    return static_cast<double>(count) * step * step;
}

class SeenIn : public ::testing::TestWithParam<Shown (*)()> {};
INSTANTIATE_TEST_SUITE_P(EveryProp, SeenIn,
                         ::testing::Values(&in_frustum, &in_cube, &beyond_frustum, &in_hexagon,
                                           &in_tetrahedron, &in_gem));

TEST_P(SeenIn, WholeAndLostMatchARayCast) {
    Shown shown = GetParam()();
    shown.setup.hull = shown.artifact.corners;
    const FaceReader reader(shown.setup);
    bench::Seeded seeded(11);
    int whole = 0;
    int saved = 0; // whole, though a seen face is not entirely lit
    int lost = 0;
    for (int k = 0; k < 600; ++k) {
        const GuidedState tracked_state = bench::seeded_situation(shown.setup, seeded);
        const double traced = traced_lost_px(shown, tracked_state);
        const double lost_px = reader.lost_px(tracked_state);
        if (reader.whole(tracked_state)) {
            ++whole;
            saved += reader.valid(tracked_state) ? 0 : 1;
            EXPECT_EQ(traced, 0.0) << k;
            EXPECT_LT(lost_px, 1e-6) << k;
            continue;
        }
        ++lost;
        EXPECT_GT(lost_px, 0.0) << k;
        // A raster of every fifth pixel errs by about its step along the outline of the lost area.
        EXPECT_NEAR(lost_px, traced, 0.04 * lost_px + 500.0) << k;
    }
    EXPECT_GT(whole, 20);
    EXPECT_GT(saved, 10);
    EXPECT_GT(lost, 100);
}

/// An eye on the axis over a square hole, with a cube below: small steps of the hole across the cube's silhouette.
TEST(SeenPlaces, SeesThroughAHoleExactlyWithinTheSilhouette) {
    const std::array<glm::dvec3, 8> cube{{{-1, -1, -3},
                                          {1, -1, -3},
                                          {-1, 1, -3},
                                          {1, 1, -3},
                                          {-1, -1, -1},
                                          {1, -1, -1},
                                          {-1, 1, -1},
                                          {1, 1, -1}}};
    const glm::dvec3 eye(0.0, 0.0, 1.0);
    // The cube's top is seen through |x|, |y| <= 0.5 on the plane z = 0.
    for (const double gap : {-1e-3, -1e-6, 1e-6, 1e-3}) {
        for (const glm::dvec2 along : {glm::dvec2(1, 0), glm::dvec2(0, -1), glm::dvec2(-1, 0)}) {
            const glm::dvec2 middle = (0.5 + 0.1 + gap) * along;
            const std::array<glm::dvec3, 4> hole{{{middle.x - 0.1, middle.y - 0.1, 0.0},
                                                  {middle.x + 0.1, middle.y - 0.1, 0.0},
                                                  {middle.x + 0.1, middle.y + 0.1, 0.0},
                                                  {middle.x - 0.1, middle.y + 0.1, 0.0}}};
            EXPECT_EQ(sees_through(eye, FacePart(hole), cube), gap < 0.0);
            EXPECT_NEAR(SeenOutline(eye, {0, 0, -1}, cube).area_through(FacePart(hole)),
                        std::max(0.0, -gap) * 0.2, 1e-12);
        }
        // A corner of the hole in front of a corner of the silhouette.
        const double at = 0.5 + gap;
        const std::array<glm::dvec3, 4> diamond{
            {{at, at, 0.0}, {at + 0.2, at - 0.1, 0.0}, {at + 0.2, at + 0.2, 0.0}, {at - 0.1, at + 0.2, 0.0}}};
        EXPECT_EQ(sees_through(eye, FacePart(diamond), cube), gap < 0.0);
    }
    // The hole inside the silhouette, and the silhouette inside the hole.
    const auto square = [](double half) {
        return std::array<glm::dvec3, 4>{
            {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}}};
    };
    EXPECT_TRUE(sees_through(eye, FacePart(square(0.1)), cube));
    EXPECT_TRUE(sees_through(eye, FacePart(square(2.0)), cube));
    EXPECT_NEAR(SeenOutline(eye, {0, 0, -1}, cube).area_through(FacePart(square(2.0))), 1.0, 1e-12);
}

} // namespace
} // namespace frustumscreen::guidance
