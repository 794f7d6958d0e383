// The next mip level against sums computed by hand.

#include "app/image/image.h"

#include <gtest/gtest.h>

#include <cmath>

namespace frustumscreen::image {
namespace {

TEST(HalfSize, AveragesLinearLight) {
    Image8 image(2, 2, {0, 0, 0, 255});
    image.at(0, 0) = {255, 255, 0, 255};
    image.at(1, 1) = {255, 0, 0, 255};
    const Image8 half = half_size(image);
    ASSERT_EQ(half.width, 1);
    ASSERT_EQ(half.height, 1);
    EXPECT_EQ(half.at(0, 0), glm::u8vec4(188, 137, 0, 255)); // half and a quarter of the light, IEC 61966-2-1
}

TEST(HalfSize, KeepsEveryCodeOfAUniformPicture) {
    for (int code = 0; code < 256; ++code) {
        const auto c = static_cast<std::uint8_t>(code);
        EXPECT_EQ(half_size(Image8(4, 6, {c, c, c, c})).at(1, 2), glm::u8vec4(c, c, c, c)) << code;
    }
}

TEST(HalfSize, WeightsTexelsOfAnOddPictureByArea) {
    Image8 image(5, 1, {0, 0, 0, 255});
    image.at(2, 0) = {255, 255, 255, 255}; // the middle texel: half of it goes to each side
    const Image8 half = half_size(image);
    ASSERT_EQ(half.width, 2);
    ASSERT_EQ(half.height, 1);
    const auto expected = static_cast<int>(std::lround(255.0 * srgb_from_linear(0.5 / 2.5)));
    EXPECT_EQ(half.at(0, 0).r, expected);
    EXPECT_EQ(half.at(1, 0).r, expected);
    EXPECT_EQ(half_size(Image8(1, 1, {9, 9, 9, 255})).at(0, 0), glm::u8vec4(9, 9, 9, 255));
}

} // namespace
} // namespace frustumscreen::image
