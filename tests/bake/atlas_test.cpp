#include "assets_baked/bake/atlas.h"

#include <gtest/gtest.h>

#include <random>

namespace frustumscreen::bake {

TEST(Atlas, PackedRectanglesNeitherOverlapNorLeaveThePicture) {
    std::mt19937 random(7);
    for (int round = 0; round < 40; ++round) {
        std::vector<glm::ivec2> sizes;
        const int count = 1 + static_cast<int>(random() % 300U);
        long area = 0;
        for (int k = 0; k < count; ++k) {
            sizes.emplace_back(1 + static_cast<int>(random() % 60U), 1 + static_cast<int>(random() % 60U));
            area += static_cast<long>(sizes.back().x) * sizes.back().y;
        }
        sizes.emplace_back(0, 0);
        sizes.emplace_back(0, 0);
        const AtlasLayout layout = pack_rectangles(sizes);
        std::vector<int> owner(
            static_cast<std::size_t>(layout.width) * static_cast<std::size_t>(layout.height), -1);
        for (std::size_t k = 0; k < sizes.size(); ++k) {
            const glm::ivec2 corner = layout.corners[k];
            ASSERT_GE(corner.x, 0);
            ASSERT_GE(corner.y, 0);
            ASSERT_LE(corner.x + sizes[k].x, layout.width);
            ASSERT_LE(corner.y + sizes[k].y, layout.height);
            for (int y = corner.y; y < corner.y + sizes[k].y; ++y) {
                for (int x = corner.x; x < corner.x + sizes[k].x; ++x) {
                    int& texel = owner[static_cast<std::size_t>(y) * static_cast<std::size_t>(layout.width) +
                                       static_cast<std::size_t>(x)];
                    ASSERT_EQ(texel, -1);
                    texel = static_cast<int>(k);
                }
            }
        }
        if (count > 50) {
            EXPECT_LT(static_cast<double>(layout.width) * layout.height, 1.5 * static_cast<double>(area));
        }
    }
}

} // namespace frustumscreen::bake
