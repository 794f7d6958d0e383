// The estimate of a frame's own error: which eye decides, what a pixel adds, and when there is no estimate.

#include "app/scene/error_estimate.h"

#include <gtest/gtest.h>

#include <array>

namespace frustumscreen::scene {
namespace {

/// A triangle in the prop, facing up, under a projector that looks straight down.
struct Kiosk {
    geometry::PropShape prop = geometry::make_frustum({});
    PlacedLevel artifact;
    glm::dvec3 eye{0.0, -0.6, 0.6};
    PlanView view{
        {1280, 800, 1872.0, 1872.0, 640.0, 400.0}, {{0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.2}}, {}, {}, {}};

    Kiosk() {
        pack::PackLevel level;
        for (const auto& [x, y] : {std::array{0, 0}, {65535, 0}, {32768, 65535}}) {
            level.vertices.push_back(
                {{static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), 32768}, 0, {}});
        }
        level.indices = {0, 1, 2};
        pack::PackCluster all;
        all.index_count = 3;
        all.centre = {0.0F, 0.0F, 0.5F};
        all.radius = 0.87F;
        level.clusters = {all};
        artifact = {std::make_shared<LevelTriangles>(triangles_of(level, glm::dvec3(1.0))),
                    glm::dvec3(1.0),
                    0.08,
                    {MeshId{1}, {TextureId{2}}}};
    }
    std::optional<ErrorEstimate> estimate(const SeenLevel& seen) {
        view.eyes_m = std::span(&eye, 1);
        FramePlan plan = make_plan(prop, artifact);
        plan_frame(prop, artifact, view, plan);
        return estimate_error(seen, prop, artifact, view, plan);
    }
};

/// The eye sees a single patch, at the middle of the box.
pack::SeenEye eye_at(const glm::dvec3& towards) {
    pack::SeenEye eye;
    eye.towards = towards;
    eye.patches[0] = {{0.0, 0.0, 0.5}, 1.0};
    return eye;
}

pack::SeenError seen_of(float mean_box) {
    pack::SeenError seen{mean_box, 3.0F * mean_box, 0.0F, 0.0F, {}};
    seen.patches_box.fill(mean_box);
    return seen;
}

TEST(ErrorEstimate, IsTheBoxErrorInMillimetresOnTheProp) {
    Kiosk kiosk;
    const std::optional<ErrorEstimate> error =
        kiosk.estimate({{eye_at({0, 0, 1}), eye_at({0, -1, 0})}, {seen_of(2e-3F), seen_of(2e-3F)}});
    ASSERT_TRUE(error);
    EXPECT_NEAR(error->mean_mm, 2e-3 * 80.0, 1e-3); // pixels add only micrometres
    EXPECT_NEAR(error->p95_mm, 6e-3 * 80.0, 1e-3);
}

TEST(ErrorEstimate, IsInterpolatedForTheViewingEye) {
    Kiosk kiosk;
    const SeenLevel seen{{eye_at({0, 0, 1}), eye_at({0, -1, 0}), eye_at({0, 1, 0})},
                         {seen_of(4e-3F), seen_of(2e-3F), seen_of(1e-3F)}};
    kiosk.eye = {0.0, -1.0, 0.04};
    EXPECT_NEAR(kiosk.estimate(seen)->mean_mm, 0.16, 2e-3);
    kiosk.eye = {0.0, 0.0, 1.0};
    EXPECT_NEAR(kiosk.estimate(seen)->mean_mm, 0.32, 2e-3);
    // A rotated prop shows its other side.
    kiosk.eye = {0.0, -1.0, 0.04};
    kiosk.view.table_from_prop.rotation = glm::dquat(0.0, 0.0, 0.0, 1.0);
    EXPECT_NEAR(kiosk.estimate(seen)->mean_mm, 0.08, 2e-3);
    // Between two eyes the estimate is between their errors.
    kiosk.view.table_from_prop.rotation = glm::dquat(1.0, 0.0, 0.0, 0.0);
    kiosk.eye = {0.0, -0.7, 0.74};
    const double between = kiosk.estimate(seen)->mean_mm;
    EXPECT_GT(between, 0.17);
    EXPECT_LT(between, 0.31);
}

TEST(ErrorEstimate, ExactLevelErrsByAShareOfAPixel) {
    Kiosk kiosk;
    const SeenLevel exact{{eye_at({0, 0, 1})}, {pack::SeenError{}}};
    const double near_mm = kiosk.estimate(exact)->mean_mm;
    EXPECT_GT(near_mm, 0.0);
    kiosk.view.projector.fx /= 2.0; // pixels twice as large
    kiosk.view.projector.fy /= 2.0;
    EXPECT_NEAR(kiosk.estimate(exact)->mean_mm, 2.0 * near_mm, 0.02 * near_mm);
    kiosk.eye = {0.0, -1.0, 0.2}; // at a grazing view a face shows more of the artifact in fewer pixels
    EXPECT_GT(kiosk.estimate(exact)->mean_mm, 2.0 * near_mm);
}

TEST(ErrorEstimate, IsMissingWhenNothingIsVisible) {
    Kiosk kiosk;
    const SeenLevel seen{{eye_at({0, 0, 1})}, {seen_of(1e-3F)}};
    ASSERT_TRUE(kiosk.estimate(seen));
    kiosk.eye = {0.0, 0.0, 0.02}; // inside the prop
    EXPECT_FALSE(kiosk.estimate(seen));
    kiosk.eye = {0.0, -0.6, 0.6};
    kiosk.view.table_from_prop.translation.x = 3.0; // outside the picture
    EXPECT_FALSE(kiosk.estimate(seen));
    kiosk.view.table_from_prop.translation.x = 0.0;
    kiosk.view.brightness = 0.0;
    EXPECT_FALSE(kiosk.estimate(seen));
}

// The projector looks straight down on the top, which gets more pixels for what is seen through it than the
// side.
TEST(ErrorEstimate, WeighsAPatchByThePixelsOfItsFace) {
    Kiosk kiosk;
    kiosk.eye = {0.0, -0.3, 0.7};
    pack::SeenEye eye = eye_at({0, -1, 0});
    eye.patches[0] = {{0.0, 0.0, 1.4}, 0.5};  // 0.112 m high: through the top
    eye.patches[1] = {{0.0, -0.3, 0.1}, 0.5}; // low and in front: through the side
    pack::SeenError above = seen_of(1e-3F);
    above.patches_box[1] = 0.0F;
    pack::SeenError below = seen_of(1e-3F);
    below.patches_box[0] = 0.0F;
    const double of_top = kiosk.estimate({{eye}, {above}})->mean_mm;
    const double of_side = kiosk.estimate({{eye}, {below}})->mean_mm;
    EXPECT_NEAR(of_top + of_side, 0.08, 4e-3); // the shares of all pixels
    EXPECT_GT(of_top, 1.3 * of_side);
    const FramePlan plan = [&] {
        FramePlan made = make_plan(kiosk.prop, kiosk.artifact);
        plan_frame(kiosk.prop, kiosk.artifact, kiosk.view, made);
        return made;
    }();
    double top = 0.0;
    double side = 0.0;
    for (const FacePlan& face : plan.faces) {
        const glm::dvec3& normal = kiosk.prop.faces[static_cast<std::size_t>(face.face)].plane.normal;
        top = normal.z > 0.9 ? face.pixels_per_m : top;
        side = normal.y < -0.5 ? face.pixels_per_m : side;
    }
    ASSERT_GT(side, 0.0);
    EXPECT_NEAR(of_top / of_side, top * top / (side * side), 0.1 * of_top / of_side);
}

TEST(ErrorEstimate, WorstOfTakesTheMaximumOfEachFigure) {
    const pack::SeenError worst = worst_of(
        {{pack::SeenEye{}, pack::SeenEye{}}, {{1.0F, 2.0F, 3.0F, 4.0F, {}}, {2.0F, 1.0F, 5.0F, 0.0F, {}}}});
    EXPECT_EQ(worst.mean_box, 2.0F);
    EXPECT_EQ(worst.p95_box, 2.0F);
    EXPECT_EQ(worst.outline_shift_box, 5.0F);
    EXPECT_EQ(worst.silhouette_share, 4.0F);
}

TEST(ErrorEstimate, FallsBackToTheSurfaceDistanceOfAnOlderPack) {
    pack::PackOutline outline;
    outline.levels.resize(2);
    outline.levels[1].error = {1e-3F, 4e-3F, 1.0F, 0.0F};
    const std::vector<SeenLevel> seen = seen_by_eyes(outline).value().levels;
    ASSERT_EQ(seen.size(), 2U);
    EXPECT_FLOAT_EQ(worst_of(seen[1]).mean_box, 2e-3F); // tests/bake checks the factor against rays
    EXPECT_FLOAT_EQ(worst_of(seen[1]).p95_box, 8e-3F);
    Kiosk kiosk;
    EXPECT_NEAR(kiosk.estimate(seen[1])->mean_mm, 0.16, 2e-3);
    pack::put_seen_errors({{eye_at({0.0, 0.6, 0.8})}, {{seen_of(0.5F)}, {seen_of(0.25F)}}, {}},
                          outline.description);
    EXPECT_FLOAT_EQ(worst_of(seen_by_eyes(outline).value().levels[1]).mean_box, 0.25F);
    outline.levels.resize(3);
    EXPECT_FALSE(seen_by_eyes(outline));
}

} // namespace
} // namespace frustumscreen::scene
