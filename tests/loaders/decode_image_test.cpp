#include "assets_baked/bake/loaders/decode_image.h"
#include "firmware_host/base/file.h"
#include "tests/loaders/loaders_testing.h"
#include "tests/loaders/picture_forms.h"
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

/// Halves until at most `kept_texels` are left.
bake::Halvings within(std::int64_t kept_texels) {
    return [kept_texels](const glm::ivec2& size) { return bake::halvings_within(size, kept_texels); };
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

TEST(DecodeImage, TiffAlphaDoesNotChangeColours) {
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

TEST(DecodeImage, RejectsInvalidHeaders) {
    const image::Image8 truth = smooth_picture(64, 64);
    const auto altered = [](std::string bytes, std::size_t place, const std::string& with) {
        return bytes.replace(place, with.size(), with);
    };
    const std::string most("\xff\xff\xff\x7f", 4);
    const std::string least("\0\0\0\x80", 4);
    const std::string none(4, '\0');
    const std::vector<std::pair<std::string, std::string>> refusals{
        {altered(bmp_of(truth), 18, most), "picture.too_large"},
        {altered(bmp_of(truth), 22, most), "picture.too_large"},
        {altered(bmp_of(truth), 22, least), "picture.too_large"},
        {altered(bmp_of(truth), 18, none), "picture.no_texels"},
        {altered(bmp_of(truth), 10, most), "picture.bitmap_damaged"},
        {altered(bmp_of(truth), 28, "\x40"), "picture.bitmap_damaged"},
        {altered(bmp_of(truth), 14, "\xff"), "picture.bitmap_damaged"},
        {altered(bmp_of(truth), 30, "\x1"), "picture.bitmap_damaged"},
        {altered(tga_of(truth), 12, "\xff\xff"), "picture.bitmap_damaged"},
        {altered(tga_of(truth), 14, none.substr(2)), "picture.no_texels"},
        {altered(tga_of(truth), 0, "\xff"), "picture.bitmap_damaged"},
        {altered(tga_of(truth, true), 14, "\xff\xff"), "picture.bitmap_damaged"},
        {altered(tiff_of(truth), 4, most), "picture.tiff_damaged"}};
    for (const auto& [bytes, refusal] : refusals) {
        const Result<image::Image8> picture = bake::decode_image(as_bytes(bytes));
        ASSERT_FALSE(picture.has_value()) << refusal << bytes.substr(0, 40);
        EXPECT_EQ(picture.error().id.view(), refusal) << picture.error().message;
    }
}

TEST(DecodeImage, ReadsPngsOfEveryDepthAsSrgbAndIgnoresGamma) {
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

TEST(DecodeImage, RejectsTruncatedPictures) {
    const image::Image8 truth = smooth_picture(64, 64);
    const std::vector<std::pair<std::string, std::string>> pictures{
        {png_of(truth), "picture.png_"},
        {webp_of(truth), "picture.webp_"},
        {jpeg_of(truth), "picture.jpeg_damaged"},
        {tiff_of(truth), "picture.tiff_damaged"},
        {bmp_of(truth), "picture.bitmap_damaged"},
        {tga_of(truth), "picture.bitmap_damaged"},
        {tga_of(truth, true), "picture.bitmap_damaged"}};
    for (const auto& [whole, refusal] : pictures) {
        for (const std::size_t length :
             {std::size_t{12}, std::size_t{30}, whole.size() / 2, whole.size() - 20}) {
            const Result<image::Image8> picture =
                bake::decode_image(as_bytes(std::string_view(whole).substr(0, length)));
            ASSERT_FALSE(picture.has_value()) << length << " of " << whole.size() << ", " << refusal;
            // A TGA has no mark before the end of its header.
            const bool is_unknown =
                refusal == "picture.bitmap_damaged" && !whole.starts_with("BM") && length < 18;
            EXPECT_TRUE(
                picture.error().id.view().starts_with(is_unknown ? "picture.unknown_format" : refusal))
                << length << " of " << whole.size() << ", " << refusal << ": " << picture.error().id.view();
        }
    }
}

TEST(DecodeImage, RejectsAPictureBeyondTheLimitAndNamesItsSize) {
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
        const Result<bake::ShrunkImage> shrunk = bake::decode_shrunk(as_bytes(whole), within(16 * 8));
        ASSERT_TRUE(shrunk) << shrunk.error().message;
        EXPECT_EQ(shrunk->file_size, glm::ivec2(64, 32));
        ASSERT_EQ(glm::ivec2(shrunk->image.width, shrunk->image.height), glm::ivec2(16, 8));
        EXPECT_LE(largest_difference(shrunk->image, quarter), whole.starts_with("\xff\xd8") ? 8 : 1);
        const Result<bake::ShrunkImage> least = bake::decode_shrunk(as_bytes(whole), within(1));
        ASSERT_TRUE(least) << least.error().message;
        EXPECT_EQ(least->image.texels.size(), 1U);
        const Result<bake::ShrunkImage> kept = bake::decode_shrunk(as_bytes(whole), within(64 * 32));
        ASSERT_TRUE(kept) << kept.error().message;
        EXPECT_EQ(kept->image.texels, bake::decode_image(as_bytes(whole))->texels);
    }
}

TEST(DecodeImage, ShrinksJpegPngAndTiffWhileDecoding) {
    const PictureForm rgb{.channels = Channels::Rgb};
    const image::Image8 truth = random_picture_for(rgb, 512, 512, 1);
    constexpr std::int64_t memory = 512 * 64; // of the whole picture there is no room
    for (const std::string& whole : {jpeg_of(truth), png_of(truth), tiff_in_form(truth, rgb)}) {
        EXPECT_TRUE(bake::decode_shrunk(as_bytes(whole), within(64 * 64), memory));
        const Result<bake::ShrunkImage> larger =
            bake::decode_shrunk(as_bytes(whole), within(256 * 256), memory);
        ASSERT_FALSE(larger);
        EXPECT_EQ(larger.error().id, "picture.too_large");
    }
    const PictureForm interlaced{.channels = Channels::Rgb, .interlaced = true};
    const PictureForm from_below{.channels = Channels::Rgb, .orientation = 4};
    const PictureForm one_strip{.channels = Channels::Rgb, .rows_a_strip = 512};
    for (const std::string& whole :
         {webp_of(truth), bmp_of(truth), tga_of(truth), png_in_form(truth, interlaced),
          tiff_in_form(truth, from_below), tiff_in_form(truth, one_strip)}) {
        const Result<bake::ShrunkImage> shrunk =
            bake::decode_shrunk(as_bytes(whole), within(64 * 64), memory);
        ASSERT_FALSE(shrunk);
        EXPECT_EQ(shrunk.error().id, "picture.too_large");
    }
}

/// Decodes and shrinks `file`, and compares it with its texels, halved as a whole picture.
void expect_texels(const std::string& file, const image::Image8& truth, const std::string& form) {
    image::Image8 expected = truth;
    for (int halvings = 0; halvings <= 3; ++halvings) {
        const Result<bake::ShrunkImage> shrunk =
            bake::decode_shrunk(as_bytes(file), [&](const glm::ivec2&) { return halvings; });
        ASSERT_TRUE(shrunk) << form << ": " << shrunk.error().message;
        EXPECT_EQ(shrunk->file_size, glm::ivec2(truth.width, truth.height));
        ASSERT_EQ(shrunk->image.width, expected.width) << form;
        ASSERT_EQ(shrunk->image.height, expected.height) << form;
        EXPECT_LE(largest_difference(shrunk->image, expected), 1)
            << form << ", halved " << halvings << " times";
        expected = image::half_size(expected);
    }
}

TEST(DecodeImage, ShrinkingWhileDecodingEqualsHalvingTheWholePicture) {
    int refused = 0;
    const std::vector<glm::ivec2> sizes{{37, 53}, {64, 130}, {1, 9}, {101, 1}};
    for (const glm::ivec2& size : sizes) {
        for (const Channels channels :
             {Channels::Grey, Channels::GreyAlpha, Channels::Palette, Channels::Rgb, Channels::Rgba}) {
            for (const int depth : {8, 16}) {
                if (channels == Channels::Palette && depth == 16) {
                    continue;
                }
                PictureForm form{.channels = channels, .depth = depth};
                const image::Image8 truth = random_picture_for(form, size.x, size.y, 3);
                const std::string name = std::to_string(size.x) + " x " + std::to_string(size.y) +
                                         ", channels " + std::to_string(static_cast<int>(channels)) + ", " +
                                         std::to_string(depth) + " bits";
                for (const bool interlaced : {false, true}) {
                    form.interlaced = interlaced;
                    expect_texels(png_in_form(truth, form), truth, "PNG, " + name);
                }
                image::Image8 opaque = truth;
                for (glm::u8vec4& texel : opaque.texels) { // a TIFF's palette has no alpha
                    texel.a = channels == Channels::Palette ? std::uint8_t{255} : texel.a;
                }
                for (const int rows : {1, 7, 40, 1000, 0}) {
                    form.rows_a_strip = rows;
                    form.packed = rows != 40;
                    const std::string file = tiff_in_form(truth, form);
                    const bool grey = channels == Channels::Grey || channels == Channels::GreyAlpha;
                    const bool two_bytes = depth == 16 || channels == Channels::GreyAlpha;
                    if ((depth == 16 && channels == Channels::GreyAlpha) ||
                        (grey && two_bytes && rows == 0 &&
                         size.x % 32 != 0)) { // libtiff 4.5 unpacks it wrongly
                        EXPECT_EQ(bake::decode_image(as_bytes(file)).error().id, "picture.tiff_damaged");
                        ++refused;
                        continue;
                    }
                    expect_texels(file, opaque,
                                  "TIFF, " + name + ", " + std::to_string(rows) + " rows a strip");
                }
            }
        }
    }
    EXPECT_EQ(refused, 4 * 5 + 3 * 2);
}

TEST(DecodeImage, RejectsUnknownFormats) {
    for (const std::string_view bytes : {"", "GIF89a", "RIFF1234WAVE", "\xff"}) {
        const Result<image::Image8> picture = bake::decode_image(as_bytes(bytes));
        ASSERT_FALSE(picture.has_value()) << bytes;
        EXPECT_EQ(picture.error().id, "picture.unknown_format") << bytes;
    }
}

} // namespace
} // namespace frustumscreen::testing
