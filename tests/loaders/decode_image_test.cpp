#include "assets_baked/bake/loaders/decode_image.h"
#include "firmware_host/base/file.h"
#include "tests/loaders/loaders_testing.h"
#include "tests/loaders/sample_pictures.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cstdlib>

namespace frustumscreen::testing {
namespace {

int largest_difference(const image::Image8& a, const image::Image8& b) {
    int largest = 0;
    for (std::size_t i = 0; i < a.texels.size(); ++i) {
        for (int k = 0; k < 4; ++k) {
            largest = std::max(largest, std::abs(int{a.texels[i][k]} - int{b.texels[i][k]}));
        }
    }
    return largest;
}

TEST(DecodeImage, PngJpegAndWebpGiveTheSamePicture) {
    const image::Image8 truth = smooth_picture(32, 16);
    const std::vector<std::pair<std::string, int>> forms = {
        {png_of(truth), 0}, {webp_of(truth), 0}, {jpeg_of(truth), 8}};
    for (const auto& [bytes, tolerance] : forms) {
        const Result<image::Image8> picture = bake::decode_image(as_bytes(bytes));
        ASSERT_TRUE(picture.has_value()) << picture.error().message;
        ASSERT_EQ(picture->width, 32);
        ASSERT_EQ(picture->height, 16);
        EXPECT_LE(largest_difference(*picture, truth), tolerance);
    }
}

TEST(DecodeImage, BmpTgaAndTiffGiveTheSamePicture) {
    image::Image8 truth = smooth_picture(33, 16); // rows of a BMP end in padding bytes
    for (int x = 4; x < 9; ++x) {
        truth.at(x, 3) = glm::u8vec4(1, 2, 3, 255); // a run of equal texels
    }
    for (const std::string& bytes : {bmp_of(truth), bmp_of(truth, true), tga_of(truth), tga_of(truth, true),
                                     tiff_of(truth), tiff_of(truth, TiffAlpha::None, true)}) {
        const Result<image::Image8> picture = bake::decode_image(as_bytes(bytes));
        ASSERT_TRUE(picture.has_value()) << picture.error().message;
        ASSERT_EQ(picture->width, 33);
        ASSERT_EQ(picture->height, 16);
        EXPECT_EQ(largest_difference(*picture, truth), 0) << bytes.substr(0, 2);
    }
}

TEST(DecodeImage, AnAlphaInATiffLeavesTheColoursAsTheyAre) {
    image::Image8 truth = smooth_picture(32, 16);
    for (std::size_t k = 0; k < truth.texels.size(); ++k) {
        truth.texels[k].a = static_cast<std::uint8_t>(k % 256);
    }
    const Result<image::Image8> apart = bake::decode_image(as_bytes(tiff_of(truth, TiffAlpha::Apart)));
    ASSERT_TRUE(apart.has_value()) << apart.error().message;
    EXPECT_EQ(largest_difference(*apart, truth), 0);
    const Result<image::Image8> multiplied =
        bake::decode_image(as_bytes(tiff_of(truth, TiffAlpha::Multiplied)));
    ASSERT_TRUE(multiplied.has_value()) << multiplied.error().message;
    for (std::size_t k = 0; k < truth.texels.size(); ++k) {
        const int alpha = truth.texels[k].a;
        EXPECT_EQ(int{multiplied->texels[k].a}, alpha);
        for (int c = 0; c < 3 && alpha > 0; ++c) { // tolerance for rounding to a fraction of 255
            EXPECT_NEAR(multiplied->texels[k][c], truth.texels[k][c], 128.0 / alpha + 1.0);
        }
    }
}

TEST(DecodeImage, SizesThatTheBytesDoNotHoldAreRefused) {
    const image::Image8 truth = smooth_picture(64, 64);
    const auto altered = [](std::string bytes, std::size_t place, const std::string& with) {
        return bytes.replace(place, with.size(), with);
    };
    const std::string most("\xff\xff\xff\x7f", 4);
    const std::string least("\0\0\0\x80", 4);
    for (const std::string& bytes :
         {altered(bmp_of(truth), 18, most), altered(bmp_of(truth), 22, most),
          altered(bmp_of(truth), 22, least), altered(bmp_of(truth), 10, most),
          altered(bmp_of(truth), 28, "\x40"), altered(bmp_of(truth), 14, "\xff"),
          altered(bmp_of(truth), 30, "\x1"), altered(tga_of(truth), 12, "\xff\xff"),
          altered(tga_of(truth), 14, std::string(2, '\0')), altered(tga_of(truth), 0, "\xff"),
          altered(tga_of(truth, true), 14, "\xff\xff"), altered(tiff_of(truth), 4, most)}) {
        const Result<image::Image8> picture = bake::decode_image(as_bytes(bytes));
        EXPECT_FALSE(picture.has_value()) << bytes.substr(0, 40);
    }
}

TEST(DecodeImage, PngsOfEveryDepthAreReadAsSrgbWhateverTheirGammaNoteSays) {
    for (const int depth : {1, 2, 4, 8, 16}) {
        for (const bool gamma : {false, true}) {
            const std::string png = grey_ramp_png(depth, gamma);
            const Result<image::Image8> picture = bake::decode_image(as_bytes(png));
            ASSERT_TRUE(picture.has_value()) << picture.error().message;
            const int codes = 1 << std::min(depth, 8);
            for (int x = 0; x < picture->width; ++x) {
                const int expected = depth == 16 ? x * 255 / (picture->width - 1) : x * 255 / (codes - 1);
                EXPECT_NEAR(picture->at(x, 0).r, expected, depth == 16 ? 1 : 0)
                    << depth << " bits, x = " << x;
                EXPECT_EQ(picture->at(x, 0).a, 255);
            }
        }
    }
}

TEST(DecodeImage, TruncatedPicturesAreDamaged) {
    const image::Image8 truth = smooth_picture(64, 64);
    for (const std::string& whole : {png_of(truth), webp_of(truth), jpeg_of(truth), tiff_of(truth),
                                     bmp_of(truth), tga_of(truth), tga_of(truth, true)}) {
        for (const std::size_t length :
             {std::size_t{12}, std::size_t{30}, whole.size() / 2, whole.size() - 20}) {
            EXPECT_FALSE(bake::decode_image(as_bytes(std::string_view(whole).substr(0, length))).has_value())
                << length << " of " << whole.size();
        }
    }
}

TEST(DecodeImage, APictureBeyondTheLimitIsRefusedBeforeItIsUnpacked) {
    const image::Image8 truth = smooth_picture(64, 64);
    for (const std::string& whole : {png_of(truth), webp_of(truth), jpeg_of(truth), tiff_of(truth),
                                     bmp_of(truth), tga_of(truth), tga_of(truth, true)}) {
        const Result<image::Image8> picture = bake::decode_image(as_bytes(whole), 64 * 64 - 1);
        ASSERT_FALSE(picture.has_value());
        EXPECT_NE(picture.error().message.find("64 x 64"), std::string::npos);
    }
}

TEST(DecodeImage, ALargePictureIsHalvedUntilItFits) {
    const image::Image8 truth = smooth_picture(64, 32);
    const image::Image8 quarter = image::half_size(image::half_size(truth));
    for (const std::string& whole :
         {png_of(truth), webp_of(truth), jpeg_of(truth), tiff_of(truth), bmp_of(truth), tga_of(truth)}) {
        const Result<bake::ShrunkImage> shrunk = bake::decode_shrunk(as_bytes(whole), 16 * 8);
        ASSERT_TRUE(shrunk) << shrunk.error().message;
        EXPECT_EQ(shrunk->file_size, glm::ivec2(64, 32));
        ASSERT_EQ(glm::ivec2(shrunk->image.width, shrunk->image.height), glm::ivec2(16, 8));
        EXPECT_LE(largest_difference(shrunk->image, quarter), whole.starts_with("\xff\xd8") ? 8 : 1);
        const Result<bake::ShrunkImage> least = bake::decode_shrunk(as_bytes(whole), 1);
        ASSERT_TRUE(least) << least.error().message;
        EXPECT_EQ(least->image.texels.size(), 1U);
        const Result<bake::ShrunkImage> kept = bake::decode_shrunk(as_bytes(whole), 64 * 32);
        ASSERT_TRUE(kept) << kept.error().message;
        EXPECT_EQ(kept->image.texels, bake::decode_image(as_bytes(whole))->texels);
    }
}

TEST(DecodeImage, AJpegIsShrunkWhileItIsDecoded) {
    const image::Image8 truth = smooth_picture(64, 32);
    const std::int64_t memory = 16 * 8; // of the whole picture there is no room
    EXPECT_TRUE(bake::decode_shrunk(as_bytes(jpeg_of(truth)), 16 * 8, memory));
    const Result<bake::ShrunkImage> png = bake::decode_shrunk(as_bytes(png_of(truth)), 16 * 8, memory);
    ASSERT_FALSE(png);
    EXPECT_EQ(png.error().id, "picture.too_large");
}

TEST(DecodeImage, OtherFormsAreNamedAsUnreadable) {
    for (const std::string_view bytes : {"", "GIF89a", "RIFF1234WAVE", "\xff"}) {
        EXPECT_FALSE(bake::decode_image(as_bytes(bytes)).has_value());
    }
}

} // namespace
} // namespace frustumscreen::testing
