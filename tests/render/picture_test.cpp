// The renderer's picture against a plain ray cast of the same triangles.

#include "tests/render/comparison.h"
#include "tests/render/mass.h"
#include "tests/render/rig.h"

#include <algorithm>
#include <map>
#include <string>

namespace frustumscreen::synthetic {
namespace {

TEST(Picture, HitPointsMatchARayCastOverRandomPoses) {
    Rig rig(256, 160);
    TestTable table(256, 160);
    const ReferenceCast cast(rig.pack, rig.level.metres_per_box);
    std::mt19937 random(7);
    for (int pose = 0; pose < 8; ++pose) {
        table.shuffle(random);
        scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
        const Comparison c = compare(table, cast, rig.places());
        EXPECT_GT(c.both, 600U) << pose;
        EXPECT_LT(c.worst_mm, 0.02) << pose;
        EXPECT_EQ(c.unexcused, 0U) << pose << ": of " << c.mismatched << " mismatched";
    }
}

TEST(Picture, HitPointsMatchForExtremeEyesAndProjectors) {
    Rig rig(256, 160);
    const ReferenceCast cast(rig.pack, rig.level.metres_per_box);
    TestTable overhead(256, 160);
    overhead.eye_m = {0.001, 0.002, 1.4};
    TestTable far(256, 160);
    far.eye_m = {3.0, -40.0, 20.0};
    TestTable close(256, 160);
    close.eye_m = {0.02, -0.13, 0.20};
    TestTable shifted(256, 160); // lens shift, different focal lengths, the prop partly outside the picture
    shifted.projector.cx = 60.0;
    shifted.projector.fy *= 1.3;
    shifted.table_from_prop.translation = {-0.05, 0.03, 0.0};
    TestTable oblique(256, 160); // the projector tilts over from the visitor's side
    const double lean = 0.6;
    oblique.table_from_projector.rotation =
        glm::angleAxis(lean, glm::dvec3(1, 0, 0)) * oblique.table_from_projector.rotation;
    oblique.table_from_projector.translation = {0.0, -0.9 * std::sin(lean), 0.05 + 0.9 * std::cos(lean)};
    const std::map<std::string, TestTable> tables{
        {"overhead", overhead}, {"far", far}, {"close", close}, {"shifted", shifted}, {"oblique", oblique}};
    for (const auto& [which, table] : tables) {
        scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
        const Comparison c = compare(table, cast, rig.places());
        EXPECT_GT(c.both, 300U) << which;
        EXPECT_LT(c.worst_mm, 0.02) << which;
        EXPECT_EQ(c.unexcused, 0U) << which << ": of " << c.mismatched << " mismatched";
    }
}

TEST(Picture, ColoursAreTheTexturesCodesWithoutCompensation) {
    Rig rig(128, 80);
    TestTable table(128, 80);
    for (int code = 0; code < 256; ++code) {
        const auto c = static_cast<std::uint8_t>(code);
        const auto inverse = static_cast<std::uint8_t>(255 - code);
        std::fill(rig.pack.textures[0].texels.begin(), rig.pack.textures[0].texels.end(),
                  glm::u8vec4(c, inverse, 128, 255));
        rig.upload_again();
        scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
        rig.draw(render::Redraw::Everything);
        std::size_t shown = 0;
        for (const glm::u8vec4& texel : rig.picture().texels) {
            if (texel != glm::u8vec4(0, 0, 0, 255)) {
                ++shown;
                ASSERT_EQ(texel, glm::u8vec4(c, inverse, 128, 255)) << code;
            }
        }
        ASSERT_GT(shown, 100U);
    }
}

TEST(Picture, CullingChangesNoPixel) {
    Rig rig(320, 200);
    TestTable table(320, 200);
    std::mt19937 random(11);
    std::uint64_t drawn = 0;
    std::uint64_t possible = 0;
    for (int pose = 0; pose < 40; ++pose) {
        table.shuffle(random);
        if (pose % 4 == 3) { // at the picture's edge
            table.table_from_prop.translation += glm::dvec3(0.17, -0.08, 0.0);
        }
        scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
        drawn += rig.plan.indices.size();
        rig.draw(render::Redraw::Everything);
        const image::Image8 culled_picture = rig.picture();
        draw_everything(rig.plan, rig.pack.levels[0].indices);
        possible += rig.plan.indices.size();
        rig.draw(render::Redraw::Everything);
        ASSERT_EQ(rig.picture().texels, culled_picture.texels) << pose;
    }
    EXPECT_LT(drawn * 10, possible * 6) << "culling leaves out less than 40 % of the triangles";
}

TEST(Picture, LiesWithinATwentiethOfAPixelOfARayCast) {
    pack::Pack white = rings(16, 8);
    std::fill(white.textures[0].texels.begin(), white.textures[0].texels.end(), glm::u8vec4(255));
    Rig rig(256, 160, 16, white);
    const ReferenceCast cast(rig.pack, metres_per_box(rig.pack, rig.prop));
    TestTable table(256, 160);
    std::mt19937 random(5);
    for (int pose = 0; pose < 2; ++pose) {
        const Mass truth = cast_mass(cast, table);
        ASSERT_GT(truth.light, 400.0);
        scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
        rig.draw(render::Redraw::Everything);
        const Mass shown = shown_mass(rig.picture());
        EXPECT_NEAR(shown.light, truth.light, 0.01 * truth.light) << pose;
        EXPECT_LT(glm::distance(shown.centre(), truth.centre()), 0.05) << pose;
        table.shuffle(random);
    }
}

TEST(Picture, FourSamplesSmoothOnlyTheOutlines) {
    Rig sharp(256, 160, 1);
    TestTable table(256, 160);
    scene::plan_frame(table.prop, sharp.level, table.view(), sharp.plan);
    sharp.draw();
    const image::Image8 one = sharp.picture();
    Rig smooth(256, 160, 4);
    scene::plan_frame(table.prop, smooth.level, table.view(), smooth.plan);
    smooth.draw();
    const image::Image8 four = smooth.picture();
    std::size_t same = 0;
    std::size_t between = 0;
    for (std::size_t k = 0; k < one.texels.size(); ++k) {
        if (one.texels[k].g > 0) {
            // Red and green vary smoothly over the surface; blue is a checkerboard, finer than a pixel on
            // steep faces.
            same += glm::distance(glm::vec2(one.texels[k]), glm::vec2(four.texels[k])) < 12.0F ? 1U : 0U;
            between += four.texels[k].g > 0 && four.texels[k].g + 20 < one.texels[k].g ? 1U : 0U;
        }
    }
    EXPECT_GT(same * 10, lit_pixels(one) * 7);
    EXPECT_GT(between, lit_pixels(one) / 50);
}

} // namespace
} // namespace frustumscreen::synthetic
