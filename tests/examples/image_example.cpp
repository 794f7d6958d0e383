// A picture is an array of texels. Averages are taken in linear light, and PNG files are lossless.
#include "app/image/image.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Image) {
    // example
    image::Image8 board(2, 2, glm::u8vec4(0, 0, 0, 255));
    board.at(0, 0) = board.at(1, 1) = glm::u8vec4(255);
    const image::Image8 grey = image::half_size(board);
    EXPECT_EQ(grey.at(0, 0).r, 188); // half of the light: 255 (1.055 * 0.5^(1 / 2.4) - 0.055)

    const Bytes png = image::encode_png(board);
    EXPECT_EQ(image::decode_png8(png).value().texels, board.texels);
    // end
}

} // namespace
} // namespace frustumscreen::example
