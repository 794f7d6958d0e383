// A patch's points against the splatting of the same depth pixels in 64 bits, and against the rasterizer.
#include "app/ldi/patch_layers.h"
#include "app/ldi/point_patch.h"
#include "app/ldi/seen_points.h"
#include "app/ldi/triangle_rasterizer.h"
#include "tests/ldi/patch_scene.h"
#include "tests/ldi/worlds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <random>

namespace frustumscreen::ldi {
namespace {

constexpr double point_radius_m = 0.5;
const CameraView point_view{.half_extent_m = {0.1, 0.1}, .width = 128, .height = 128, .margin = 1.8};

LayeredDepth layers_of(const Hemisphere& hemisphere, const TriangleWorld& world, std::size_t patch) {
    std::array<DepthPicture, camera_count> pictures;
    TriangleRasterizer rasterizer;
    for (std::size_t camera = 0; camera < camera_count; ++camera) {
        pictures[camera].begin(camera_at(point_view, hemisphere.cameras()[camera]));
        rasterizer.draw(world, pictures[camera]);
    }
    return patch_layers(hemisphere, patch, pictures, point_view);
}

DepthPicture empty_for(const glm::dvec3& eye) {
    DepthPicture picture;
    picture.begin(camera_through_window(eye, point_view.half_extent_m, point_view.width, point_view.height));
    return picture;
}

DepthPicture splatted(const PointPatch& patch, const glm::dvec3& eye,
                      relief::Instructions instructions = relief::best_instructions()) {
    DepthPicture picture = empty_for(eye);
    PointSplatter().draw(patch, picture, instructions);
    return picture;
}

/// Eyes around the middle of a patch, at 0.7 to 1.3 of the cameras' distance.
std::vector<glm::dvec3> eyes_of(const Hemisphere& hemisphere, std::size_t patch) {
    std::mt19937 random(static_cast<unsigned>(patch));
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    std::vector<glm::dvec3> eyes;
    for (int k = 0; k < 8; ++k) {
        const glm::dvec3 toward =
            hemisphere.middle_of(patch) + 0.12 * glm::dvec3(u(random), u(random), u(random));
        eyes.push_back(point_radius_m * (1.0 + 0.3 * u(random)) * glm::normalize(toward));
    }
    return eyes;
}

class PointPatches : public testing::TestWithParam<std::size_t> {
protected:
    Hemisphere hemisphere{point_radius_m};
    TriangleWorld world = spheres_before_a_wall();
    LayeredDepth layers = layers_of(hemisphere, world, GetParam());
    PointPatch patch = point_patch(layers);
};

TEST_P(PointPatches, MatchSplattingIn64Bits) {
    for (const glm::dvec3& eye : eyes_of(hemisphere, GetParam())) {
        const DepthPicture picture = splatted(patch, eye);
        DepthPicture exact = empty_for(eye);
        splat_by_depth(layers, exact);
        std::size_t lit = 0;
        std::size_t other = 0;
        for (std::size_t k = 0; k < exact.nearness.size(); ++k) {
            lit += exact.colours[k].a != 0 ? 1 : 0;
            // An overlap that rounds differently may add a neighbour's point at an edge, or one of nearly the same depth.
            other += picture.colours[k].a != exact.colours[k].a ||
                             std::fabs(picture.nearness[k] - exact.nearness[k]) > 0.01F * exact.nearness[k]
                         ? 1
                         : 0;
        }
        EXPECT_GT(lit, exact.nearness.size() / 2);
        EXPECT_LE(other, exact.nearness.size() / 200);
    }
}

TEST_P(PointPatches, MatchTheRasterizer) {
    for (const glm::dvec3& eye : eyes_of(hemisphere, GetParam())) {
        const DepthPicture picture = splatted(patch, eye);
        DepthPicture truth = empty_for(eye);
        TriangleRasterizer().draw(world, truth);
        std::size_t holes = 0;
        double off = 0.0;
        for (std::size_t k = 0; k < truth.nearness.size(); ++k) {
            holes += truth.colours[k].a != 0 && picture.colours[k].a == 0 ? 1 : 0;
            off += std::fabs(static_cast<double>(picture.nearness[k] - truth.nearness[k])) > 0.02 ? 1.0 : 0.0;
        }
        EXPECT_LE(holes, truth.nearness.size() / 100);
        EXPECT_LE(off, 0.05 * static_cast<double>(truth.nearness.size())) << "outlines move by a pixel";
    }
}

TEST_P(PointPatches, AreEqualWithPlainAndBestInstructions) {
    for (const glm::dvec3& eye : eyes_of(hemisphere, GetParam())) {
        const DepthPicture plain = splatted(patch, eye, relief::Instructions::Plain);
        const DepthPicture best = splatted(patch, eye);
        EXPECT_EQ(plain.colours, best.colours);
        EXPECT_EQ(plain.nearness, best.nearness);
    }
}

TEST_P(PointPatches, OmitPointsThatNoEyeSees) {
    SeenPoints maker(patch, hemisphere, GetParam(), point_view);
    while (maker.step()) {
    }
    const PointPatch seen = maker.take();
    EXPECT_LT(seen.places.size(), patch.places.size());
    ASSERT_EQ(seen.seen.size(), seen.places.size() / block_points);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> share(min_eye_share, max_eye_share);
    std::size_t skipped = 0;
    std::size_t pixels = 0;
    std::size_t holes = 0;
    for (int k = 0; k < 40; ++k) {
        const glm::dvec3 eye = share(random) * seeded_eye(hemisphere, GetParam(), random);
        const CellMask cell = seen.cells.cell_of(eye);
        ASSERT_EQ(std::popcount(cell), 1);
        skipped += static_cast<std::size_t>(std::count_if(
            seen.seen.begin(), seen.seen.end(), [cell](CellMask cells) { return (cells & cell) == 0; }));
        const DepthPicture all = splatted(patch, eye);
        const DepthPicture some = splatted(seen, eye);
        for (std::size_t pixel = 0; pixel < all.colours.size(); ++pixel) {
            pixels += all.colours[pixel].a != 0 ? 1 : 0;
            holes += all.colours[pixel].a != 0 && some.nearness[pixel] < 0.98F * all.nearness[pixel] ? 1 : 0;
        }
    }
    EXPECT_GT(skipped, seen.seen.size()); // of 40 times as many
    EXPECT_LE(holes, pixels / 200);
    const glm::dvec3 last = max_eye_share * seeded_eye(hemisphere, GetParam(), random);
    EXPECT_EQ(seen.cells.cell_of(1.1 * last), seen.cells.cell_of((1.0 - 1e-9) * last)) << "a little outside";
    for (const glm::dvec3& beyond :
         {glm::dvec3(0.0, 0.0, 0.1), glm::dvec3(0.0, 0.0, 2.0), glm::dvec3(1.0, 0.0, 0.1)}) {
        EXPECT_EQ(seen.cells.cell_of(beyond), all_cells);
    }
}

INSTANTIATE_TEST_SUITE_P(EachKind, PointPatches, testing::Values(0, 1, 4));

TEST(PointPatch, DrawsNothingForAnEyeOnOrBehindTheWindow) {
    const Hemisphere hemisphere(point_radius_m);
    const PointPatch patch = point_patch(layers_of(hemisphere, spheres_before_a_wall(), 0));
    for (const double z : {0.0, -1e-9, -0.3, std::nan("")}) {
        const DepthPicture picture = splatted(patch, {0.05, 0.0, z});
        for (const glm::u8vec4& colour : picture.colours) {
            ASSERT_EQ(colour.a, 0) << z;
        }
    }
}

TEST(PointPatch, DrawsNothingWithoutPoints) {
    const Hemisphere hemisphere(point_radius_m);
    const PointPatch patch = point_patch(layers_of(hemisphere, {}, 3));
    EXPECT_EQ(patch.bytes(), 0U);
    for (const glm::u8vec4& colour : splatted(patch, {0.0, 0.0, point_radius_m}).colours) {
        ASSERT_EQ(colour.a, 0);
    }
}

TEST(PointPatch, ReplacesTheWholePicture) {
    const Hemisphere hemisphere(point_radius_m);
    const PointPatch patch = point_patch(layers_of(hemisphere, spheres_before_a_wall(), 0));
    const glm::dvec3 eye(0.0, 0.0, point_radius_m);
    DepthPicture used = empty_for(eye);
    used.colours.assign(used.colours.size(), glm::u8vec4(9));
    used.nearness.assign(used.nearness.size(), 9.0F);
    PointSplatter splatter;
    splatter.draw(patch, used);
    const DepthPicture fresh = splatted(patch, eye);
    EXPECT_EQ(used.colours, fresh.colours);
    EXPECT_EQ(used.nearness, fresh.nearness);
}

} // namespace
} // namespace frustumscreen::ldi
