// Properties of lossless WebP alone; lossless_test.cpp has those shared with PNG.

#include "tests/image/pictures.h"

#include <gtest/gtest.h>
#include <webp/encode.h>

using namespace frustumscreen;
using namespace frustumscreen::image;

TEST(WebP, begins_with_the_webp_signature) {
    EXPECT_TRUE(begins_as_webp(encode_webp(noise(61, 37, true))));
    EXPECT_FALSE(begins_as_webp(encode_png(noise(61, 37, true))));
}

TEST(WebP, is_smaller_than_png_for_a_smooth_picture) {
    const Image8 image = smooth(400, 300);
    EXPECT_LT(encode_webp(image).size(), encode_png(image).size());
}

TEST(WebP, a_picture_that_is_too_wide_gives_no_bytes) {
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
    EXPECT_EQ(back.error().id, "image.webp_not_lossless") << back.error().message;
}
