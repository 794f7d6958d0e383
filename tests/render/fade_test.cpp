// A fade from one level to another: every pixel belongs to exactly one of the two pictures.

#include "tests/render/counted_new.h"
#include "tests/render/rig.h"

#include <algorithm>

namespace frustumscreen::synthetic {
namespace {

/// Two levels of one artifact: the points of the coarse one are points of the fine one, so the box is the
/// same.
struct FadeRig : Rig {
    Pack coarse_pack = rings(12, 4);
    std::optional<ArtifactGpu> coarse;
    PlacedLevel coarse_level;

    explicit FadeRig(int samples) : Rig(320, 200, samples) {
        EXPECT_EQ(coarse_pack.box_size, pack.box_size);
        renderer = Renderer::create(320, 200, needs(samples, true)).value();
        coarse = ArtifactGpu::upload(coarse_pack, 0).value();
        coarse_level = placed(coarse_pack, 0, level.metres_per_box, 2);
        level.samples = coarse_level.samples = 0;
        plan = make_plan(prop, level.triangles->indices.size() + coarse_level.triangles->indices.size());
    }
    DrawResult draw_plan(const ArtifactGpu* first, const ArtifactGpu* coming) {
        const DrawResult result = renderer->draw(
            plan, {first, nullptr, coming}, {display->framebuffer(), display->buffer_age()}, Redraw::Changes);
        EXPECT_TRUE(display->present(MonotonicTime{}));
        return result;
    }
    Image8 one(const Stage& stage, const PlacedLevel& which, const ArtifactGpu& gpu) {
        plan_frame(prop, which, stage.view(LightCompensation{}), plan);
        draw_plan(&gpu, nullptr);
        return picture();
    }
    /// From the fine level to the coarse one.
    Image8 fade(const Stage& stage, double share) {
        PlanView view = stage.view(LightCompensation{});
        view.fade = LevelFade{coarse_level.triangles.get(), coarse_level.id, share};
        plan_frame(prop, level, view, plan);
        EXPECT_TRUE(draw_plan(&*artifact, &*coarse).drawn);
        return picture();
    }
};

/// Two samples a pixel are averaged by a bilinear fetch whose weights the driver rounds: one code either way.
bool same(const glm::u8vec4& a, const glm::u8vec4& b, int samples) {
    const glm::ivec3 difference = glm::abs(glm::ivec3(a) - glm::ivec3(b));
    return std::max({difference.r, difference.g, difference.b}) <= (samples == 2 ? 1 : 0);
}

class Fading : public ::testing::TestWithParam<int> {};

TEST_P(Fading, GivesEveryPixelToExactlyOneOfTheTwoLevels) {
    FadeRig rig(GetParam());
    Stage stage(320, 200);
    std::mt19937 random(11);
    for (int pose = 0; pose < 4; ++pose) {
        stage.shuffle(random);
        const Image8 from = rig.one(stage, rig.level, *rig.artifact);
        const Image8 to = rig.one(stage, rig.coarse_level, *rig.coarse);
        EXPECT_EQ(rig.fade(stage, 0.0).texels, from.texels);
        EXPECT_EQ(rig.fade(stage, 1.0).texels, to.texels);
        std::vector<bool> arrived(from.texels.size(), false);
        std::size_t differing = 0;
        for (std::size_t k = 0; k < from.texels.size(); ++k) {
            differing += same(from.texels[k], to.texels[k], GetParam()) ? 0U : 1U;
        }
        ASSERT_GT(differing, 500U);
        for (const double share : {0.1, 0.3, 0.5, 0.8}) {
            const Image8 middle = rig.fade(stage, share);
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

TEST_P(Fading, IsLeftOutByARendererThatWasMadeWithoutItsShader) {
    FadeRig rig(GetParam());
    rig.renderer = Renderer::create(320, 200, needs(GetParam())).value();
    const Stage stage(320, 200);
    EXPECT_GT(lit_pixels(rig.one(stage, rig.level, *rig.artifact)), 1000U);
    EXPECT_EQ(lit_pixels(rig.fade(stage, 0.5)), 0U);
    EXPECT_EQ(rig.renderer->shaders(), shaders_of(needs(GetParam()))); // none was made for it
}

INSTANTIATE_TEST_SUITE_P(Samples, Fading, ::testing::Values(1, 2, 4, 8));

TEST(Fading, AllocatesNothing) {
    if (!allocations_are_counted) {
        GTEST_SKIP() << "allocations are not counted under a sanitizer";
    }
    FadeRig rig(4);
    Stage stage(320, 200);
    std::mt19937 random(5);
    long counted = 0;
    for (int k = 0; k < 60; ++k) {
        stage.shuffle(random);
        PlanView view = stage.view(LightCompensation{});
        view.fade = LevelFade{rig.coarse_level.triangles.get(), rig.coarse_level.id, k / 60.0};
        const long before = allocations_so_far();
        plan_frame(rig.prop, rig.level, view, rig.plan);
        counted += allocations_so_far() - before;
        const long before_draw = allocations_so_far();
        rig.draw_plan(&*rig.artifact, &*rig.coarse);
        counted += k < 20 ? 0 : allocations_so_far() - before_draw; // llvmpipe compiles in its first frames
    }
    EXPECT_EQ(counted, 0);
}

} // namespace
} // namespace frustumscreen::synthetic
