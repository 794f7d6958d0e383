// The reserved code of every presented picture, and the cost of a picture at rest.

#include "app/render/probe.h"
#include "tests/render/rig.h"

#include <GLES3/gl31.h>

namespace frustumscreen::synthetic {
namespace {

TEST(Probe, RoundTripChangesNoOtherPixel) {
    Rig rig(320, 200);
    TestTable table(320, 200);
    scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
    const render::DrawResult drawn = rig.draw();
    const image::Image8 plain = rig.picture();
    EXPECT_FALSE(render::read_probe(plain)); // the offline renderer's pictures have none
    EXPECT_FALSE(render::read_probe(rig.display->framebuffer()));
    for (unsigned code = 0; code < 256; ++code) {
        ASSERT_TRUE(
            render::write_probe(rig.display->framebuffer(), static_cast<std::uint8_t>(code), drawn.lit));
        image::Image8 picture = rig.picture();
        ASSERT_EQ(render::read_probe(picture), static_cast<std::uint8_t>(code));
        ASSERT_EQ(render::read_probe(rig.display->framebuffer()), static_cast<std::uint8_t>(code));
        int changed = 0;
        int brightest = 0;
        for (std::size_t k = 0; k < plain.texels.size(); ++k) {
            changed += picture.texels[k] != plain.texels[k] ? 1 : 0;
            if (picture.texels[k] != plain.texels[k]) {
                brightest = std::max<int>(brightest, picture.texels[k].r);
            }
        }
        ASSERT_EQ(changed, probe_pixels);
        ASSERT_LE(brightest, 2); // of 255
        render::erase_probe(picture);
        ASSERT_EQ(picture.texels, plain.texels);
    }
}

TEST(Probe, IsNotWrittenOverLitPixels) {
    Rig rig(320, 200);
    TestTable table(320, 200);
    // The prop in the picture's top left corner.
    table.table_from_prop.translation = {-0.19, 0.12, 0.0};
    scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
    const render::DrawResult drawn = rig.draw();
    ASSERT_EQ(drawn.lit.x, 0);
    ASSERT_EQ(drawn.lit.y, 0);
    const image::Image8 plain = rig.picture();
    EXPECT_FALSE(render::write_probe(rig.display->framebuffer(), 5, drawn.lit));
    EXPECT_EQ(rig.picture().texels, plain.texels);
}

TEST(Probe, IsNotReadFromBlackWhiteOrTinyPictures) {
    EXPECT_FALSE(render::read_probe(image::Image8(320, 200)));
    EXPECT_FALSE(render::read_probe(image::Image8(320, 200, {255, 255, 255, 255})));
    EXPECT_FALSE(render::read_probe(image::Image8(320, 200, {1, 2, 1, 255})));
    EXPECT_FALSE(render::read_probe(image::Image8(3, 1, {1, 1, 1, 255})));
    EXPECT_EQ(render::read_probe(image::Image8(8, 1, {2, 2, 2, 255})), std::uint8_t{255});
}

TEST(PictureAtRest, APictureShownAgainIsNotDrawnAgain) {
    Rig rig(320, 200, 4);
    TestTable table(320, 200);
    scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
    rig.draw();
    const image::Image8 shown = rig.picture();
    const render::DrawResult again = rig.draw(render::Redraw::Again);
    EXPECT_TRUE(again.drawn);
    EXPECT_TRUE(again.redrawn.empty());
    EXPECT_EQ(again.draw_calls, 0);
    EXPECT_EQ(rig.picture().texels, shown.texels);
    EXPECT_FALSE(rig.draw().drawn);
}

TEST(PictureAtRest, UpdatesTheBufferThatLacksThePicture) {
    Rig rig(320, 200);
    TestTable table(320, 200);
    const unsigned framebuffer = rig.display->framebuffer();
    const auto draw = [&](int age, render::Redraw redraw) {
        return rig.renderer->draw(rig.plan, {framebuffer, age}, redraw);
    };
    scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
    draw(0, render::Redraw::Changes);
    table.table_from_prop.translation.x = 0.01;
    scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
    draw(0, render::Redraw::Changes);
    EXPECT_FALSE(draw(2, render::Redraw::Again).redrawn.empty()); // this buffer still holds the first picture
    EXPECT_TRUE(draw(2, render::Redraw::Again).redrawn.empty());
}

/// Counts pixels: all others are filled with a grey that is never drawn, and must keep it.
TEST(PictureAtRest, MovedPropRedrawsOnlyItsRectangle) {
    Rig rig(640, 400);
    TestTable table(640, 400, false);
    scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
    const PixelRectangle before = rig.draw().lit;
    glBindFramebuffer(GL_FRAMEBUFFER, rig.display->framebuffer());
    glDisable(GL_SCISSOR_TEST);
    glClearColor(0.5F, 0.25F, 0.5F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    const glm::u8vec4 grey = rig.picture().at(0, 0);
    table.table_from_prop.translation.x += 0.004;
    scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
    const PixelRectangle after = scene::lit_bounds(rig.plan);
    rig.draw();
    int drawn = 0;
    int outside = 0;
    const image::Image8 picture = rig.picture();
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const auto in = [&](const PixelRectangle& r) {
                return x >= r.x && x < r.x + r.width && y >= r.y && y < r.y + r.height;
            };
            const bool redrawn = picture.at(x, y) != grey;
            drawn += redrawn ? 1 : 0;
            outside += redrawn && !in(united(before, after)) ? 1 : 0;
        }
    }
    const PixelRectangle both = united(before, after);
    EXPECT_EQ(outside, 0);
    EXPECT_EQ(drawn, both.width * both.height);
    EXPECT_LT(drawn, 640 * 400 / 8);
    EXPECT_LT(drawn, after.width * after.height * 11 / 10);
}

} // namespace
} // namespace frustumscreen::synthetic
