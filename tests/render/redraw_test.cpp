// Redraws only changed parts.

#include "tests/render/rig.h"

namespace frustumscreen::synthetic {
namespace {

class Redrawing : public ::testing::TestWithParam<int> {};

TEST_P(Redrawing, PartialRedrawEqualsFullRedrawOverARandomWalk) {
    std::vector<image::Image8> shown;
    for (const render::Redraw redraw : {render::Redraw::Everything, render::Redraw::Changes}) {
        Rig rig(320, 200, GetParam());
        TestTable table(320, 200, false);
        std::mt19937 random(3);
        std::normal_distribution<double> step(0.0, 0.02);
        for (std::size_t k = 0; k < 40; ++k) {
            if (k % 10 == 9) {
                table.shuffle(random);
            }
            table.table_from_prop.translation += glm::dvec3(step(random), step(random), 0.0);
            scene::plan_frame(table.prop, rig.level, table.view(scene::LightCompensation{}), rig.plan);
            const render::DrawResult result = rig.draw(redraw);
            if (redraw == render::Redraw::Everything) {
                shown.push_back(rig.picture());
                continue;
            }
            if (k > 0) {
                EXPECT_LT(result.redrawn.width * result.redrawn.height, 320 * 200 / 2);
            }
            ASSERT_EQ(rig.picture().texels, shown[k].texels) << k;
        }
    }
}

TEST_P(Redrawing, NothingIsDrawnWhenNothingChanged) {
    Rig rig(320, 200, GetParam());
    TestTable table(320, 200);
    scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
    EXPECT_TRUE(rig.draw().drawn);
    for (int k = 0; k < 3; ++k) {
        scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
        const render::DrawResult result = rig.draw();
        EXPECT_FALSE(result.drawn);
        EXPECT_EQ(result.draw_calls, 0);
    }
    table.eye_m.x += 1e-4;
    scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
    EXPECT_TRUE(rig.draw().drawn);
    rig.level.drawable = rig.renderer->store().upload(rig.pack, 0).value(); // another artifact
    scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
    EXPECT_TRUE(rig.draw().drawn);
}

TEST_P(Redrawing, ErasesAnArtifactThatIsRemoved) {
    Rig rig(320, 200, GetParam());
    TestTable table(320, 200);
    scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
    rig.draw();
    EXPECT_GT(lit_pixels(rig.picture()), 1000U);
    scene::plan_frame(table.prop, scene::PlacedLevel{}, table.view(), rig.plan);
    EXPECT_TRUE(rig.draw().drawn);
    EXPECT_EQ(lit_pixels(rig.picture()), 0U);
    EXPECT_FALSE(rig.draw().drawn);
}

INSTANTIATE_TEST_SUITE_P(Samples, Redrawing, ::testing::Values(1, 2, 4));

TEST(Redrawing, RedrawsWhatAnOlderBufferMissed) {
    // Two alternating buffers, as in a page-flipping display: each holds the picture before the last.
    Rig rig(320, 200);
    TestTable table(320, 200, false);
    PixelRectangle before_last;
    PixelRectangle last;
    for (int k = 0; k < 6; ++k) {
        table.table_from_prop.translation = {0.03 * k - 0.1, 0.0, 0.0};
        scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
        const render::DrawResult result =
            rig.renderer->draw(rig.plan, {rig.display->framebuffer(), k < 2 ? 0 : 2});
        if (k >= 2) {
            EXPECT_EQ(result.redrawn, united(before_last, rig.plan.lit.bounds()));
        }
        before_last = last;
        last = rig.plan.lit.bounds();
    }
}

} // namespace
} // namespace frustumscreen::synthetic
