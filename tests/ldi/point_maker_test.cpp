// Making patches of points in steps: the order, any division of the work, the memory, and the picture where an eye crosses from one
// patch to the next.
#include "app/ldi/point_maker.h"
#include "tests/ldi/patch_scene.h"
#include "tests/ldi/worlds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace frustumscreen::ldi {
namespace {

constexpr std::uint64_t plenty = std::uint64_t{1} << 30U;

CameraView making_view(int px) {
    return {.half_extent_m = glm::dvec2(half_window_m), .width = px, .height = px, .margin = 1.4};
}

bool same_points(const PointPatch& a, const PointPatch& b) {
    return a.places == b.places && a.nearness == b.nearness && a.slopes == b.slopes && a.colours == b.colours;
}

TEST(PointMaker, PatchesDoNotDependOnStepSizes) {
    const Hemisphere hemisphere(eye_distance_m);
    const CameraView view = making_view(64);
    const TriangleWorld world = town(1);
    std::mt19937 random(5);
    PointMaker in_parts({world}, hemisphere, view, plenty, 100);
    for (bool more = true; more;) {
        if (random() % 30 == 0) { // some patches are given up
            in_parts.look_from(seeded_eye(hemisphere, random() % patch_count, random));
        }
        more = in_parts.step(1 + random() % 3000);
    }
    PointMaker at_once({world}, hemisphere, view, plenty);
    while (at_once.step(1'000'000)) {
    }
    for (std::size_t patch = 0; patch < patch_count; ++patch) {
        ASSERT_TRUE(in_parts.patch(patch) && at_once.patch(patch));
        EXPECT_GT(in_parts.patch(patch)->places.size(), 1000U);
        EXPECT_TRUE(same_points(*in_parts.patch(patch), *at_once.patch(patch))) << patch;
        EXPECT_EQ(in_parts.patch(patch)->number, 100 + patch);
    }
    EXPECT_FALSE(in_parts.step());
}

TEST(PointMaker, MakesTheViewedPatchFirstAndThenByAngle) {
    const Hemisphere hemisphere(eye_distance_m);
    PointMaker maker({town(1)}, hemisphere, making_view(48), plenty);
    maker.look_from(eye_distance_m * hemisphere.middle_of(5));
    const MakingOrder order(maker);
    ASSERT_FALSE(order.patches.empty());
    EXPECT_EQ(order.patches.front(), 5U);
    EXPECT_TRUE(order.is_by_angle(hemisphere));
}

/// From every place of the hemisphere's cap, at most one pixel in 400 is empty that the rasterizer fills.
TEST(PointMaker, PatchesHaveAlmostNoHoles) {
    constexpr int px = 96;
    const Hemisphere hemisphere(eye_distance_m);
    const TriangleWorld world = spheres_before_a_wall();
    PointMaker maker({world}, hemisphere, making_view(px), plenty);
    while (maker.step()) {
    }
    std::mt19937 random(3);
    std::size_t holes = 0;
    std::size_t pixels = 0;
    for (int k = 0; k < 45; ++k) {
        const std::size_t patch = static_cast<std::size_t>(k) % patch_count;
        const glm::dvec3 eye = seeded_eye(hemisphere, patch, random);
        DepthPicture truth;
        truth.begin(camera_through_window(eye, glm::dvec2(half_window_m), px, px));
        DepthPicture picture = truth;
        TriangleRasterizer().draw(world, truth);
        PointSplatter().draw(*maker.patch(patch), picture);
        for (std::size_t pixel = 0; pixel < truth.colours.size(); ++pixel) {
            holes += truth.colours[pixel].a != 0 && picture.colours[pixel].a == 0 ? 1U : 0U;
            ++pixels;
        }
    }
    EXPECT_LE(holes, pixels / 400); // a quarter of the 1 % that a silhouette may err by
}

/// Worlds that hide each other show as one world of all their triangles does.
TEST(PointMaker, SeveralWorldsEqualOneCombinedWorld) {
    const Hemisphere hemisphere(eye_distance_m);
    const CameraView view = making_view(64);
    const TriangleWorld whole = spheres_before_a_wall();
    TriangleWorld first = whole;
    TriangleWorld second = whole;
    const auto middle = static_cast<std::ptrdiff_t>(whole.triangle_count() / 2 * 3);
    first.indices.assign(whole.indices.begin(), whole.indices.begin() + middle);
    second.indices.assign(whole.indices.begin() + middle, whole.indices.end());
    PointMaker apart({first, second}, hemisphere, view, plenty);
    PointMaker together({whole}, hemisphere, view, plenty);
    while (apart.made_count() == 0) {
        apart.step();
    }
    while (together.made_count() == 0) {
        together.step();
    }
    EXPECT_TRUE(same_points(*apart.patch(0), *together.patch(0)));
}

TEST(PointMaker, StaysWithinItsMemoryByMakingFewerPatches) {
    const Hemisphere hemisphere(eye_distance_m);
    PointMaker all({town(2)}, hemisphere, making_view(64), plenty);
    while (all.step()) {
    }
    std::uint64_t bytes = 0;
    for (std::size_t patch = 0; patch < patch_count; ++patch) {
        bytes += all.patch(patch)->bytes();
    }
    PointMaker tight({town(2)}, hemisphere, making_view(64), bytes / 2);
    while (tight.step()) {
    }
    EXPECT_GT(tight.made_count(), 1U);
    EXPECT_LT(tight.made_count(), patch_count);
    EXPECT_FALSE(tight.step());
    std::uint64_t kept = 0;
    for (std::size_t patch = 0; patch < patch_count; ++patch) {
        kept += tight.patch(patch) ? tight.patch(patch)->bytes() : 0;
    }
    EXPECT_LE(kept, bytes / 2);
}

TEST(PointMaker, MakesEmptyPatchesWithoutAWorld) {
    PointMaker maker({}, Hemisphere(eye_distance_m), making_view(16), plenty);
    while (maker.step()) {
    }
    EXPECT_EQ(maker.made_count(), patch_count);
    EXPECT_TRUE(maker.patch(3)->places.empty());
}

/// A picture at two samples along a pixel's side, averaged, as windows have it.
std::vector<glm::dvec3> averaged(const PointPatch& patch, const glm::dvec3& eye, int px) {
    DepthPicture picture;
    picture.begin(camera_through_window(eye, glm::dvec2(half_window_m), 2 * px, 2 * px));
    PointSplatter().draw(patch, picture);
    std::vector<glm::dvec3> codes;
    for (int y = 0; y < px; ++y) {
        for (int x = 0; x < px; ++x) {
            glm::dvec3 sum(0.0);
            for (int k = 0; k < 4; ++k) {
                sum += glm::dvec3(glm::u8vec3(picture.colours[picture.at(2 * x + k % 2, 2 * y + k / 2)]));
            }
            codes.push_back(0.25 * sum);
        }
    }
    return codes;
}

TEST(PointMaker, PictureChangesLittleAcrossPatchBorders) {
    constexpr int px = 96;
    const Hemisphere hemisphere(eye_distance_m);
    PointMaker maker({hills()}, hemisphere, making_view(2 * px), plenty);
    while (maker.step()) {
    }
    double sum = 0.0;
    std::size_t count = 0;
    for (int k = 0; k < 16; ++k) {
        // Between two ring patches, and between the centre and a ring patch, 1e-6 degrees to each side.
        const bool across_ring = k % 2 == 0;
        const double azimuth = across_ring ? std::numbers::pi / 8.0 + k / 2 * std::numbers::pi / 4.0
                                           : k / 2 * std::numbers::pi / 4.0;
        const double border = hemisphere.directions_of(0).max_polar_rad;
        const double polar = across_ring ? 0.8 : border;
        constexpr double step = 1e-6 * std::numbers::pi / 180.0;
        const auto eye = [&](double side) {
            const double p = polar + (across_ring ? 0.0 : side * step);
            const double a = azimuth + (across_ring ? side * step : 0.0);
            return eye_distance_m *
                   glm::dvec3(std::sin(p) * std::cos(a), std::sin(p) * std::sin(a), std::cos(p));
        };
        const std::size_t one = hemisphere.patch_of(eye(-1.0)).value();
        const std::size_t other = hemisphere.patch_of(eye(1.0)).value();
        ASSERT_NE(one, other) << k;
        const std::vector<glm::dvec3> a = averaged(*maker.patch(one), eye(-1.0), px);
        const std::vector<glm::dvec3> b = averaged(*maker.patch(other), eye(1.0), px);
        for (std::size_t pixel = 0; pixel < a.size(); ++pixel) {
            sum += glm::dot(a[pixel] - b[pixel], a[pixel] - b[pixel]) / 3.0;
            ++count;
        }
    }
    EXPECT_LE(std::sqrt(sum / static_cast<double>(count)), 2.0);
}

} // namespace
} // namespace frustumscreen::ldi
