// A fade between two levels: every pixel belongs to exactly one of the two pictures.

#include "tests/render/counted_new.h"
#include "tests/render/reference_cast.h"
#include "tests/render/rig.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen::synthetic {
namespace {

/// Two levels of one artifact: the points of the coarse one are points of the fine one, so the boxes are
/// equal.
struct FadeRig : Rig {
    pack::Pack coarse_pack = rings(12, 4);
    scene::PlacedLevel coarse;

    explicit FadeRig(int samples) : Rig(320, 200, samples) {
        EXPECT_EQ(coarse_pack.box_size, pack.box_size);
        EXPECT_TRUE(renderer->prepare(needs(samples, true)));
        hit_points = render::HitPointRenderer::create(*renderer).value();
        coarse = scene::placed(coarse_pack, 0, level.metres_per_box,
                               renderer->store().upload(coarse_pack, 0).value());
        level.samples = coarse.samples = 0;
        plan = scene::make_plan(prop, level.triangles->indices.size() + coarse.triangles->indices.size(), 2);
    }
    image::Image8 one(const TestTable& table, const scene::PlacedLevel& which) {
        scene::plan_frame(prop, which, table.view(scene::LightCompensation{}), plan);
        draw();
        return picture();
    }
    /// Fades from the fine level to the coarse one.
    image::Image8 fading(const TestTable& table, double share) {
        scene::plan_frame(prop, scene::fade(level, coarse, share), table.view(scene::LightCompensation{}),
                          plan);
        EXPECT_TRUE(draw().drawn);
        return picture();
    }
};

/// Two samples per pixel are averaged by a bilinear fetch whose weights the driver rounds: tolerance of one
/// code.
bool same(const glm::u8vec4& a, const glm::u8vec4& b, int samples) {
    const glm::ivec3 difference = glm::abs(glm::ivec3(a) - glm::ivec3(b));
    return std::max({difference.r, difference.g, difference.b}) <= (samples == 2 ? 1 : 0);
}

class Fading : public ::testing::TestWithParam<int> {};

TEST_P(Fading, GivesEveryPixelToExactlyOneOfTheTwoLevels) {
    FadeRig rig(GetParam());
    TestTable table(320, 200);
    std::mt19937 random(11);
    for (int pose = 0; pose < 4; ++pose) {
        table.shuffle(random);
        const image::Image8 from = rig.one(table, rig.level);
        const image::Image8 to = rig.one(table, rig.coarse);
        EXPECT_EQ(rig.fading(table, 0.0).texels, from.texels);
        EXPECT_EQ(rig.fading(table, 1.0).texels, to.texels);
        std::vector<bool> arrived(from.texels.size(), false);
        std::size_t differing = 0;
        for (std::size_t k = 0; k < from.texels.size(); ++k) {
            differing += same(from.texels[k], to.texels[k], GetParam()) ? 0U : 1U;
        }
        ASSERT_GT(differing, 500U);
        for (const double share : {0.1, 0.3, 0.5, 0.8}) {
            const image::Image8 middle = rig.fading(table, share);
            std::size_t coming = 0;
            std::size_t neither = 0;
            std::size_t gone_back = 0;
            for (std::size_t k = 0; k < middle.texels.size(); ++k) {
                const bool is_to = same(middle.texels[k], to.texels[k], GetParam());
                neither += is_to || same(middle.texels[k], from.texels[k], GetParam()) ? 0U : 1U;
                if (!same(from.texels[k], to.texels[k], GetParam())) {
                    coming += is_to ? 1U : 0U;
                    gone_back += arrived[k] && !is_to ? 1U : 0U;
                    arrived[k] = is_to;
                }
            }
            EXPECT_EQ(neither, 0U) << share;
            EXPECT_EQ(gone_back, 0U) << share; // each pixel changes once
            EXPECT_NEAR(static_cast<double>(coming), share * static_cast<double>(differing),
                        0.06 * static_cast<double>(differing));
        }
    }
}

TEST_P(Fading, DrawsNothingWithoutItsShader) {
    FadeRig rig(GetParam());
    rig.renderer = render::Renderer::create(320, 200, needs(GetParam())).value();
    rig.upload_again();
    const TestTable table(320, 200);
    EXPECT_GT(lit_pixels(rig.one(table, rig.level)), 1000U);
    EXPECT_EQ(lit_pixels(rig.fading(table, 0.5)), 0U);
    EXPECT_EQ(rig.renderer->shaders(),
              scene::shaders_of(needs(GetParam()))); // no shader was compiled for the fade
}

INSTANTIATE_TEST_SUITE_P(Samples, Fading, ::testing::Values(1, 2, 4, 8));

/// Bayer's matrix by its recursive definition: four copies of the matrix of half the size, with ranks
/// multiplied by four.
int bayer_rank(int x, int y, int size) {
    if (size == 1) {
        return 0;
    }
    const int half = size / 2;
    constexpr std::array<std::array<int, 2>, 2> corner{{{0, 2}, {3, 1}}};
    const auto row = static_cast<std::size_t>(y / half % 2);
    const auto column = static_cast<std::size_t>(x / half % 2);
    return 4 * bayer_rank(x % half, y % half, half) + corner[row][column];
}

TEST(Fading, PlacesMatchARayCastOfEachPixelsLevel) {
    FadeRig rig(1);
    TestTable table(320, 200);
    std::mt19937 random(9);
    table.shuffle(random);
    const ReferenceCast fine(rig.pack, rig.level.metres_per_box);
    const ReferenceCast coarse(rig.coarse_pack, rig.level.metres_per_box);
    scene::plan_frame(rig.prop, scene::fade(rig.level, rig.coarse, 0.4),
                      table.view(scene::LightCompensation{}), rig.plan);
    const image::ImageFloat drawn = rig.places();
    std::array<int, 2> compared{};
    for (int y = 0; y < drawn.height; ++y) {
        for (int x = 0; x < drawn.width; ++x) {
            const bool arrived = bayer_rank(x % 8, y % 8, 8) < 0.4 * 64 - 0.5;
            const glm::dvec2 centre(x + 0.5, y + 0.5);
            const ReferenceCast::Hit own = (arrived ? coarse : fine).through_pixel(table, centre);
            const ReferenceCast::Hit other = (arrived ? fine : coarse).through_pixel(table, centre);
            // The point identifies the drawn level only where the levels are apart.
            if (!own.found || !other.found || glm::distance(own.point, other.point) < 1e-3 ||
                std::isnan(drawn.at(x, y).x)) {
                continue;
            }
            const glm::dvec3 place(drawn.at(x, y));
            EXPECT_LT(glm::distance(place, own.point), glm::distance(place, other.point)) << x << ' ' << y;
            ++compared[arrived ? 1 : 0];
        }
    }
    EXPECT_GT(compared[0], 300);
    EXPECT_GT(compared[1], 200);
}

TEST(Fading, AllocatesNothing) {
    if (!allocations_are_counted) {
        GTEST_SKIP() << "allocations are not counted under a sanitizer";
    }
    FadeRig rig(4);
    TestTable table(320, 200);
    std::mt19937 random(5);
    long counted = 0;
    for (int k = 0; k < 60; ++k) {
        table.shuffle(random);
        const long before = allocations_so_far();
        scene::plan_frame(rig.prop, scene::fade(rig.level, rig.coarse, k / 60.0),
                          table.view(scene::LightCompensation{}), rig.plan);
        counted += allocations_so_far() - before;
        const long before_draw = allocations_so_far();
        rig.draw();
        counted += k < 20 ? 0 : allocations_so_far() - before_draw; // llvmpipe compiles in its first frames
    }
    EXPECT_EQ(counted, 0);
}

} // namespace
} // namespace frustumscreen::synthetic
