#include "assets_baked/bake/loaders/decode_image.h"
#include "firmware_host/base/file.h"
#include "tests/loaders/loaders_testing.h"
#include "tests/loaders/sample_pictures.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cstdlib>

namespace frustumscreen::testing {
namespace {

int largest_difference(const Image8& a, const Image8& b) {
    int largest = 0;
    for (std::size_t i = 0; i < a.texels.size(); ++i) {
        for (int k = 0; k < 4; ++k) {
            largest = std::max(largest, std::abs(int{a.texels[i][k]} - int{b.texels[i][k]}));
        }
    }
    return largest;
}

TEST(DecodeImage, PngJpegAndWebpGiveTheSamePicture) {
    const Image8 truth = smooth_picture(32, 16);
    const std::vector<std::pair<std::string, int>> forms = {
        {png_of(truth), 0}, {webp_of(truth), 0}, {jpeg_of(truth), 8}};
    for (const auto& [bytes, tolerance] : forms) {
        const Result<Image8> picture = decode_image(as_bytes(bytes));
        ASSERT_TRUE(picture.has_value()) << picture.error().message;
        ASSERT_EQ(picture->width, 32);
        ASSERT_EQ(picture->height, 16);
        EXPECT_LE(largest_difference(*picture, truth), tolerance);
    }
}

TEST(DecodeImage, PngsOfEveryDepthAreReadAsSrgbWhateverTheirGammaNoteSays) {
    for (const int depth : {1, 2, 4, 8, 16}) {
        for (const bool gamma : {false, true}) {
            const std::string png = grey_ramp_png(depth, gamma);
            const Result<Image8> picture = decode_image(as_bytes(png));
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
    const Image8 truth = smooth_picture(64, 64);
    for (const std::string& whole : {png_of(truth), webp_of(truth), jpeg_of(truth)}) {
        for (const std::size_t length :
             {std::size_t{12}, std::size_t{30}, whole.size() / 2, whole.size() - 20}) {
            EXPECT_FALSE(decode_image(as_bytes(std::string_view(whole).substr(0, length))).has_value())
                << length << " of " << whole.size();
        }
    }
}

TEST(DecodeImage, APictureBeyondTheLimitIsRefusedBeforeItIsUnpacked) {
    const Image8 truth = smooth_picture(64, 64);
    for (const std::string& whole : {png_of(truth), webp_of(truth), jpeg_of(truth)}) {
        const Result<Image8> picture = decode_image(as_bytes(whole), 64 * 64 - 1);
        ASSERT_FALSE(picture.has_value());
        EXPECT_NE(picture.error().message.find("64 x 64"), std::string::npos);
    }
}

TEST(DecodeImage, OtherFormsAreNamedAsUnreadable) {
    for (const std::string_view bytes : {"", "GIF89a", "RIFF1234WAVE", "\xff"}) {
        EXPECT_FALSE(decode_image(as_bytes(bytes)).has_value());
    }
}

} // namespace
} // namespace frustumscreen::testing
