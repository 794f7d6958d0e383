// Several samples per pixel in a larger picture that has room only for a part of the projector's picture.

#include "app/render/sample_grid.h"
#include "tests/render/comparison.h"
#include "tests/render/relief_rig.h"
#include "tests/render/rig.h"

namespace frustumscreen::synthetic {
namespace {

TEST(SampleGrid, TakesAsManySamplesAsThereIsRoomFor) {
    const auto display = display::SurfacelessDisplay::create(64, 64).value();
    const render::SampleGrid grid = render::SampleGrid::create({300, 200}, 4).value(); // 600 x 400 fragments
    const PixelRectangle prop{500, 300, 280, 190};
    const auto raster = [&](const PixelRectangle& lit, const PixelRectangle& around, int samples) {
        return grid.raster({1000, 800}, lit, around, samples);
    };
    const render::Raster usual = raster({550, 350, 100, 90}, prop, 4);
    EXPECT_EQ(usual.fragments, glm::ivec2(2, 2));
    EXPECT_EQ(usual.corner, glm::ivec2(500, 300)) << "that of the prop, whatever is lit";
    const render::Raster many = raster({550, 350, 100, 90}, prop, 8);
    EXPECT_EQ(many.fragments, glm::ivec2(2, 4));
    EXPECT_EQ(many.corner, glm::ivec2(550, 350)) << "all of the prop has no room with eight";
    EXPECT_EQ(raster({550, 310, 100, 180}, prop, 8).fragments, glm::ivec2(4, 2)) << "too high for 2 x 4";
    EXPECT_EQ(raster({550, 310, 200, 180}, prop, 8).fragments, glm::ivec2(2, 2)) << "too large for eight";
    const PixelRectangle lifted{100, 100, 500, 390};
    EXPECT_EQ(raster(lifted, lifted, 4).fragments, glm::ivec2(1, 1)) << "no room for two";
    EXPECT_EQ(raster({100, 100, 500, 190}, lifted, 4).fragments, glm::ivec2(1, 2));
    EXPECT_EQ(raster({550, 350, 100, 90}, prop, 1).fragments, glm::ivec2(1, 1));
    EXPECT_EQ(grid.bytes(), 8U * 600U * 400U);
}

/// But for rounding: where a grid has another size, a driver's viewport may round otherwise.
void expect_same(const image::Image8& picture, const image::Image8& other) {
    std::size_t different = 0;
    for (std::size_t k = 0; k < other.texels.size(); ++k) {
        const int off = farthest_channel(picture.texels[k], other.texels[k]);
        EXPECT_LE(off, 1) << k;
        different += off > 0 ? 1U : 0U;
    }
    EXPECT_LE(different, lit_pixels(other) / 100);
}

/// For example a lifted prop: it is drawn completely, with fewer samples.
TEST(SampleGrid, DrawsFewerSamplesWithoutRoom) {
    TestTable table(256, 160);
    const auto picture = [&](int samples, std::optional<PixelSize> outline) {
        Rig rig(256, 160);
        scene::RenderNeeds all = needs(4);
        all.outline = outline;
        EXPECT_TRUE(rig.renderer->prepare(all));
        rig.level.samples = samples;
        scene::plan_frame(table.prop, rig.level, table.view(), rig.plan);
        EXPECT_EQ(rig.plan.samples, samples);
        rig.draw(render::Redraw::Everything);
        return rig.picture();
    };
    const image::Image8 four = picture(4, std::nullopt);
    EXPECT_GT(lit_pixels(four), 900U);
    expect_same(picture(4, PixelSize{8, 8}), picture(1, std::nullopt));
    expect_same(picture(4, PixelSize{200, 150}), four);
}

} // namespace
} // namespace frustumscreen::synthetic
