#include "app/scene/lit_tiles.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace frustumscreen::scene {
namespace {

TEST(LitTiles, CoverEveryLitPixelOnceWithinThePicture) {
    std::mt19937 random(5);
    LitTiles tiles;
    for (int round = 0; round < 50; ++round) {
        const int width = 40 + static_cast<int>(random() % 300);
        const int height = 30 + static_cast<int>(random() % 200);
        std::vector<int> covered(static_cast<std::size_t>(width * height), 0);
        std::vector<bool> lit(covered.size(), false);
        tiles.begin(width, height);
        for (int part = 0; part < 6; ++part) {
            const PixelRectangle r{static_cast<int>(random() % 400) - 50,
                                   static_cast<int>(random() % 300) - 50, static_cast<int>(random() % 60),
                                   static_cast<int>(random() % 60)};
            tiles.light(r);
            for (int y = std::max(r.y, 0); y < std::min(r.y + r.height, height); ++y) {
                for (int x = std::max(r.x, 0); x < std::min(r.x + r.width, width); ++x) {
                    lit[static_cast<std::size_t>(y * width + x)] = true;
                }
            }
        }
        tiles.finish();
        PixelRectangle around;
        for (const PixelRectangle& r : tiles.rectangles()) {
            around = united(around, r);
            for (int y = r.y; y < r.y + r.height; ++y) {
                for (int x = r.x; x < r.x + r.width; ++x) {
                    ++covered.at(static_cast<std::size_t>(y * width + x));
                }
            }
        }
        EXPECT_EQ(around, tiles.bounds());
        for (std::size_t k = 0; k < covered.size(); ++k) {
            ASSERT_LE(covered[k], 1);
            ASSERT_TRUE(!lit[k] || covered[k] == 1);
        }
    }
}

TEST(LitTiles, BecomeOneRectangleWhenThereAreTooMany) {
    LitTiles tiles;
    tiles.begin(1280, 800);
    for (int y = 0; y < 800; y += 32) {
        for (int x = 0; x < 1280; x += 32) {
            tiles.light({x, y, 4, 4});
        }
    }
    tiles.finish();
    ASSERT_EQ(tiles.rectangles().size(), 1U);
    EXPECT_EQ(tiles.rectangles()[0], tiles.bounds());
}

TEST(LitTiles, ContainTheLastPixelOfALargePicture) {
    LitTiles tiles;
    tiles.begin(7680, 4320);
    tiles.light({7679, 4319, 1, 1});
    tiles.finish();
    ASSERT_EQ(tiles.rectangles().size(), 1U);
    EXPECT_EQ(tiles.rectangles()[0], (PixelRectangle{7679, 4319, 1, 1}));
}

} // namespace
} // namespace frustumscreen::scene
