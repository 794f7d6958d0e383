#include "app/image/image.h"

#include <gtest/gtest.h>
#include <webp/encode.h>

#include <random>

using namespace frustumscreen;

namespace {

/// Noise, with colours where alpha is 0 too.
Image8 noise(int width, int height, bool with_alpha) {
    std::mt19937 random(7);
    Image8 image(width, height);
    for (glm::u8vec4& texel : image.texels) {
        const auto code = static_cast<std::uint32_t>(random());
        texel = {code & 255U, (code >> 8) & 255U, (code >> 16) & 255U,
                 !with_alpha         ? 255U
                 : (code >> 30) == 0 ? 0U
                                     : code >> 24};
    }
    return image;
}

Image8 smooth(int width, int height) {
    Image8 image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            image.at(x, y) = {x * 255 / width, y * 255 / height, 90, 255};
        }
    }
    return image;
}

} // namespace

TEST(WebP, every_texel_comes_back_unchanged_under_alpha_too) {
    for (const Image8& image :
         {noise(61, 37, false), noise(61, 37, true), smooth(200, 100), noise(1, 1, true)}) {
        const Bytes webp = encode_webp(image);
        EXPECT_TRUE(begins_as_webp(webp));
        const Result<Image8> back = decode_webp8(webp);
        ASSERT_TRUE(back) << back.error().message;
        EXPECT_EQ(back->width, image.width);
        EXPECT_EQ(back->height, image.height);
        EXPECT_EQ(back->texels, image.texels);
    }
}

TEST(WebP, a_smooth_picture_takes_less_than_as_png) {
    const Image8 image = smooth(400, 300);
    EXPECT_LT(encode_webp(image).size(), encode_png(image).size());
}

TEST(WebP, what_it_cannot_hold_gives_no_bytes) {
    EXPECT_TRUE(encode_webp(Image8()).empty());
    EXPECT_FALSE(encode_webp(Image8(16383, 1)).empty());
    EXPECT_TRUE(encode_webp(Image8(16384, 1)).empty());
}

TEST(WebP, a_lossy_picture_is_refused) {
    const Image8 image = smooth(32, 32);
    std::uint8_t* lossy = nullptr;
    const std::size_t size = WebPEncodeRGBA(&image.texels[0].x, 32, 32, 4 * 32, 80.0F, &lossy);
    const Result<Image8> back = decode_webp8({reinterpret_cast<const std::byte*>(lossy), size});
    WebPFree(lossy);
    ASSERT_FALSE(back);
    EXPECT_NE(back.error().message.find("lossless"), std::string::npos);
}

TEST(WebP, a_picture_above_the_limit_is_refused_before_it_is_decoded) {
    const Bytes webp = encode_webp(noise(64, 64, false));
    EXPECT_TRUE(decode_webp8(webp, 4096));
    const Result<Image8> back = decode_webp8(webp, 4095);
    ASSERT_FALSE(back);
    EXPECT_NE(back.error().message.find("64 x 64"), std::string::npos);
}

TEST(WebP, every_truncation_is_refused) {
    const Bytes webp = encode_webp(noise(16, 16, true));
    for (std::size_t size = 0; size + 4 < webp.size(); ++size) {
        const Result<Image8> back = decode_webp8(std::span(webp).first(size));
        ASSERT_FALSE(back) << size;
        EXPECT_EQ(back.error().message.find('\n'), std::string::npos);
    }
}

TEST(WebP, altered_bytes_never_crash) {
    const Bytes webp = encode_webp(noise(16, 16, true));
    std::mt19937 random(3);
    for (int k = 0; k < 2000; ++k) {
        Bytes altered = webp;
        altered[random() % altered.size()] ^= static_cast<std::byte>(1U << (random() % 8));
        if (const Result<Image8> back = decode_webp8(altered, 1 << 20); back) {
            ASSERT_EQ(back->texels.size(),
                      static_cast<std::size_t>(back->width) * static_cast<std::size_t>(back->height));
        }
    }
}
