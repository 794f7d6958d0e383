// Making patches in steps: the order, any division of the work, and the memory.
#include "app/ldi/patch_maker.h"
#include "tests/ldi/patch_scene.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <random>
#include <vector>

namespace frustumscreen::ldi {
namespace {

PatchLimits making_limits(double texel_m = 2.0 * half_window_m / 48) {
    return {.half_extent_m = glm::dvec2(half_window_m), .texel_m = texel_m};
}

std::shared_ptr<const TriangleWorld> shared_town() {
    return std::make_shared<const TriangleWorld>(town(1));
}

template <typename Value> bool equal_bytes(const std::vector<Value>& a, const std::vector<Value>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0);
}

bool equal(const PatchRelief& a, const PatchRelief& b) {
    return equal_bytes(a.relief.corner_codes, b.relief.corner_codes) &&
           equal_bytes(a.relief.covers, b.relief.covers) && equal_bytes(a.relief.colours, b.relief.colours) &&
           equal_bytes(a.relief.first_block, b.relief.first_block) &&
           a.relief.blocks.size() == b.relief.blocks.size() &&
           std::equal(a.relief.blocks.begin(), a.relief.blocks.end(), b.relief.blocks.begin(),
                      [](const relief::ReliefBlock& x, const relief::ReliefBlock& y) {
                          return x.u0 == y.u0 && x.v0 == y.v0 && x.w0 == y.w0 && x.w_u == y.w_u &&
                                 x.w_v == y.w_v && x.residual_low == y.residual_low &&
                                 x.residual_step == y.residual_step && x.mask == y.mask && x.cut == y.cut &&
                                 x.first_cover == y.first_cover;
                      }) &&
           a.window_from_box == b.window_from_box && a.texel_m == b.texel_m;
}

TEST(PatchMaker, PatchesDoNotDependOnStepSizes) {
    const auto world = shared_town();
    const Hemisphere hemisphere(eye_distance_m);
    PatchMaker at_once(world, hemisphere, making_limits());
    while (at_once.step(1'000'000)) {
    }
    std::mt19937 random(11);
    PatchMaker in_parts(world, hemisphere, making_limits());
    // Looks from several directions, so that the order differs and some patches are given up.
    for (bool more = true; more;) {
        if (random() % 40 == 0) {
            in_parts.look_from(seeded_eye(hemisphere, random() % patch_count, random));
        }
        more = in_parts.step(1 + random() % 3000);
    }
    for (std::size_t patch = 0; patch < patch_count; ++patch) {
        ASSERT_TRUE(at_once.patch(patch) && in_parts.patch(patch));
        EXPECT_FALSE(at_once.patch(patch)->empty());
        EXPECT_TRUE(equal(*at_once.patch(patch), *in_parts.patch(patch))) << patch;
    }
    EXPECT_TRUE(equal(*at_once.patch(4), make_patch_relief(*world, hemisphere, 4, making_limits())));
}

TEST(PatchMaker, MakesTheViewedPatchFirstAndThenByAngle) {
    const Hemisphere hemisphere(eye_distance_m);
    PatchMaker maker(shared_town(), hemisphere, making_limits());
    maker.look_from(eye_distance_m * hemisphere.middle_of(5));
    const MakingOrder order(maker);
    ASSERT_FALSE(order.patches.empty());
    EXPECT_EQ(order.patches.front(), 5U);
    EXPECT_TRUE(order.is_by_angle(hemisphere));
    EXPECT_FALSE(maker.step());
    EXPECT_GT(order.calls, 100U); // small pieces
}

TEST(PatchMaker, SwitchesToTheNewlyViewedPatch) {
    const Hemisphere hemisphere(eye_distance_m);
    PatchMaker maker(shared_town(), hemisphere, making_limits());
    maker.look_from(eye_distance_m * hemisphere.middle_of(2));
    for (int k = 0; k < 60; ++k) {
        maker.step();
    }
    ASSERT_EQ(maker.made_count(), 0U);
    maker.look_from(eye_distance_m * hemisphere.middle_of(7));
    while (maker.made_count() == 0) {
        maker.step();
    }
    EXPECT_TRUE(maker.patch(7));
    EXPECT_EQ(maker.made_count(), 1U);
    maker.look_from({0.0, 0.0, -1.0}); // no patch: nothing changes
    EXPECT_TRUE(maker.step());
}

TEST(PatchBuild, KeepsWithinItsMemoryByLargerTexels) {
    const TriangleWorld world = town(2);
    const Hemisphere hemisphere(eye_distance_m);
    double before_m = 0.0;
    for (const std::uint64_t max_bytes :
         {std::uint64_t{16} << 20U, std::uint64_t{2} << 20U, std::uint64_t{600} << 10U}) {
        PatchLimits tight = making_limits(2.0 * half_window_m / 192);
        tight.max_bytes = max_bytes;
        CameraViews views = camera_views_for(world, hemisphere, tight);
        PatchBuild build(world, hemisphere, views, 1, tight);
        std::uint64_t most = 0;
        while (build.step(2000)) {
            most = std::max(most, build.bytes());
        }
        const PatchRelief relief = build.take();
        EXPECT_FALSE(relief.empty());
        EXPECT_LE(relief::bytes_of(relief.relief), max_bytes);
        // The memory that the header allows beside the limit, for at most all triangles.
        EXPECT_LE(most, max_bytes + 220 * world.triangle_count());
        EXPECT_GE(relief.texel_m, before_m);
        before_m = relief.texel_m;
    }
    EXPECT_GT(before_m, 1.5 * 2.0 * half_window_m / 192);
}

} // namespace
} // namespace frustumscreen::ldi
