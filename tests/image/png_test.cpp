#include "app/image/image.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

using namespace frustumscreen;

namespace {

Image8 noise(int width, int height, bool with_alpha) {
    std::mt19937 random(7);
    Image8 image(width, height);
    for (glm::u8vec4& texel : image.texels) {
        const auto code = static_cast<std::uint32_t>(random());
        texel = {code & 255U, (code >> 8) & 255U, (code >> 16) & 255U, with_alpha ? code >> 24 : 255U};
    }
    return image;
}

/// Width and colour type straight from the bytes of the IHDR chunk (PNG 1.2, 11.2.2).
int byte_at(const Bytes& png, std::size_t offset) {
    return std::to_integer<int>(png.at(offset));
}

} // namespace

TEST(Png, colour_comes_back_unchanged) {
    for (const bool with_alpha : {false, true}) {
        const Image8 image = noise(61, 37, with_alpha);
        const Bytes png = encode_png(image);
        EXPECT_EQ(byte_at(png, 25), with_alpha ? 6 : 2);
        const Result<Image8> back = decode_png8(png);
        ASSERT_TRUE(back) << back.error().message;
        EXPECT_EQ(back->width, 61);
        EXPECT_EQ(back->height, 37);
        EXPECT_EQ(back->texels, image.texels);
    }
}

TEST(Png, each_of_the_65536_reliefs_comes_back_unchanged) {
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

TEST(Png, the_same_picture_gives_the_same_bytes) {
    const Image8 image = noise(20, 30, true);
    EXPECT_EQ(encode_png(image), encode_png(image));
}

TEST(Png, a_picture_without_texels_gives_no_bytes) {
    EXPECT_TRUE(encode_png(Image8()).empty());
    EXPECT_TRUE(encode_png(Image16()).empty());
}

TEST(Png, colour_is_not_a_relief) {
    const Result<Image16> back = decode_png16(encode_png(noise(4, 4, false)));
    ASSERT_FALSE(back);
    EXPECT_NE(back.error().message.find("16-bit grey"), std::string::npos);
}

TEST(Png, a_picture_above_the_limit_is_refused_before_it_is_decoded) {
    const Bytes png = encode_png(noise(64, 64, false));
    EXPECT_TRUE(decode_png8(png, 4096));
    const Result<Image8> back = decode_png8(png, 4095);
    ASSERT_FALSE(back);
    EXPECT_NE(back.error().message.find("64 x 64"), std::string::npos);
}

TEST(Png, every_truncation_is_refused) {
    const Bytes png = encode_png(noise(16, 16, true));
    // The last chunk, IEND (12 bytes), holds nothing of the picture.
    for (std::size_t size = 0; size + 12 < png.size(); ++size) {
        const Result<Image8> back = decode_png8(std::span(png).first(size));
        ASSERT_FALSE(back) << size;
        EXPECT_EQ(back.error().message.find('\n'), std::string::npos);
    }
}

TEST(Png, altered_bytes_never_crash) {
    const Bytes png = encode_png(noise(16, 16, true));
    std::mt19937 random(3);
    for (int k = 0; k < 2000; ++k) {
        Bytes altered = png;
        altered[random() % altered.size()] ^= static_cast<std::byte>(1U << (random() % 8));
        const Result<Image8> back = decode_png8(altered, 1 << 20);
        if (back) {
            ASSERT_EQ(back->texels.size(),
                      static_cast<std::size_t>(back->width) * static_cast<std::size_t>(back->height));
        }
    }
}
