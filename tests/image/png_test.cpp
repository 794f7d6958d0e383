// Properties of PNG alone; lossless_test.cpp has those shared with WebP.

#include "tests/image/pictures.h"

#include <gtest/gtest.h>

using namespace frustumscreen;
using namespace frustumscreen::image;

namespace {

/// Reads bit depth and colour type directly from the bytes of the IHDR chunk (PNG 1.2, 11.2.2).
int byte_at(const Bytes& png, std::size_t offset) {
    return std::to_integer<int>(png.at(offset));
}

} // namespace

TEST(Png, alpha_is_stored_where_there_is_any) {
    EXPECT_EQ(byte_at(encode_png(noise(61, 37, true)), 25), 6);
    EXPECT_EQ(byte_at(encode_png(noise(61, 37, false)), 25), 2);
}

TEST(Png, round_trip_keeps_all_65536_heights) {
    Image16 image(256, 256);
    for (std::size_t k = 0; k < image.texels.size(); ++k) {
        image.texels[k] = static_cast<std::uint16_t>(k * 40503U);
    }
    const Bytes png = encode_png(image);
    EXPECT_EQ(byte_at(png, 24), 16);
    EXPECT_EQ(byte_at(png, 25), 0);
    const Result<Image16> back = decode_png16(png);
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->texels, image.texels);
}

TEST(Png, a_relief_without_texels_gives_no_bytes) {
    EXPECT_TRUE(encode_png(Image16()).empty());
}

TEST(Png, colour_is_not_a_relief) {
    const Result<Image16> back = decode_png16(encode_png(noise(4, 4, false)));
    ASSERT_FALSE(back);
    EXPECT_EQ(back.error().id, "image.png_not_grey16") << back.error().message;
}
