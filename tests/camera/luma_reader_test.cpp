#include "firmware_host/camera/luma_reader.h"
#include "tests/camera/fake_v4l2.h"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <algorithm>
#include <cmath>

namespace frustumscreen::camera {
namespace {

constexpr int width = 64, height = 48;
/// Codes; tolerance for quality 95, with quantisation steps of 1 to 10 codes, and for rounding of RGB.
constexpr double quantised = 5.0;

std::span<const std::byte> bytes_of(const Picture& picture) {
    return std::as_bytes(std::span(picture));
}

/// A smooth colour picture with known BT.601 luma, as JPEG.
struct Jpeg {
    Picture file;
    std::vector<double> luma;
};
Jpeg coloured_jpeg(int columns, int rows) {
    Picture rgb;
    Jpeg jpeg;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            const int red = 30 + 180 * x / columns;
            const int green = 30 + 180 * y / rows;
            const int blue = 120;
            rgb.insert(rgb.end(), {static_cast<std::uint8_t>(red), static_cast<std::uint8_t>(green),
                                   static_cast<std::uint8_t>(blue)});
            jpeg.luma.push_back(0.299 * red + 0.587 * green + 0.114 * blue);
        }
    }
    tjhandle handle = ::tjInitCompress();
    unsigned char* file = nullptr;
    unsigned long size = 0;
    EXPECT_EQ(::tjCompress2(handle, rgb.data(), columns, 0, rows, TJPF_RGB, &file, &size, TJSAMP_422, 95, 0),
              0);
    jpeg.file.assign(file, file + size);
    ::tjFree(file);
    ::tjDestroy(handle);
    return jpeg;
}

double worst(const std::vector<std::uint8_t>& found, const std::vector<double>& meant) {
    double most = 0.0;
    for (std::size_t k = 0; k < meant.size(); ++k) {
        most = std::fmax(most, std::fabs(found.at(k) - meant[k]));
    }
    return most;
}

TEST(LumaReader, CopiesGreyWithoutItsPadding) {
    LumaReader reader;
    const Picture picture = noisy_ramp(width, height, 1);
    Picture padded;
    for (int y = 0; y < height; ++y) {
        padded.insert(padded.end(), picture.begin() + y * width, picture.begin() + (y + 1) * width);
        padded.insert(padded.end(), 32, 0xEE);
    }
    std::vector<std::uint8_t> luma;
    ASSERT_TRUE(reader.read({PixelFormat::Grey, width, height, width}, bytes_of(picture), luma));
    EXPECT_EQ(luma, picture);
    ASSERT_TRUE(reader.read({PixelFormat::Grey, width, height, width + 32}, bytes_of(padded), luma));
    EXPECT_EQ(luma, picture);
}

TEST(LumaReader, ReadsEverySecondByteOfYuyv) {
    LumaReader reader;
    std::vector<std::uint8_t> luma;
    ASSERT_TRUE(reader.read({PixelFormat::Yuyv, width, height, 2 * width},
                            bytes_of(noisy_ramp(width, height, 1, 2)), luma));
    EXPECT_EQ(luma, noisy_ramp(width, height, 1));
}

TEST(LumaReader, RejectsAFrameOneByteTooShort) {
    LumaReader reader;
    std::vector<std::uint8_t> luma;
    const Picture picture = noisy_ramp(width, height, 1, 2);
    for (const PixelFormat format : {PixelFormat::Grey, PixelFormat::Yuyv}) {
        const std::size_t row = format == PixelFormat::Yuyv ? 2 * width : width;
        const auto bytes = bytes_of(picture).first(row * height);
        EXPECT_TRUE(reader.read({format, width, height, row}, bytes, luma));
        EXPECT_FALSE(reader.read({format, width, height, row}, bytes.first(bytes.size() - 1), luma));
        // A row stride smaller than its pixels is a driver's error, and read as a whole row.
        EXPECT_FALSE(reader.read({format, width, height, 1}, bytes.first(bytes.size() - 1), luma));
    }
    EXPECT_FALSE(reader.read({PixelFormat::Mjpeg, width, height, 0}, {}, luma));
}

TEST(LumaReader, DecodesTheLumaOfAJpeg) {
    LumaReader reader;
    const Jpeg jpeg = coloured_jpeg(width, height);
    std::vector<std::uint8_t> luma;
    ASSERT_TRUE(reader.read({PixelFormat::Mjpeg, width, height, 0}, bytes_of(jpeg.file), luma));
    EXPECT_LT(worst(luma, jpeg.luma), quantised);
}

/// Cameras omit the Huffman tables, which are always equal (USB Video Class, Motion-JPEG payload).
TEST(LumaReader, ReadsAJpegWithoutHuffmanTables) {
    LumaReader reader;
    Jpeg jpeg = coloured_jpeg(width, height);
    const Picture marker{0xFF, 0xC4};
    for (auto at = jpeg.file.begin(); (at = std::search(jpeg.file.begin(), jpeg.file.end(), marker.begin(),
                                                        marker.end())) != jpeg.file.end();) {
        jpeg.file.erase(at, at + 2 + at[2] * 256 + at[3]);
    }
    std::vector<std::uint8_t> luma;
    ASSERT_TRUE(reader.read({PixelFormat::Mjpeg, width, height, 0}, bytes_of(jpeg.file), luma));
    EXPECT_LT(worst(luma, jpeg.luma), quantised);
}

TEST(LumaReader, RejectsAJpegOfAnotherSizeOrTruncated) {
    LumaReader reader;
    const Jpeg jpeg = coloured_jpeg(width, height);
    const Jpeg other = coloured_jpeg(width + 1, height);
    std::vector<std::uint8_t> luma;
    const FrameFormat format{PixelFormat::Mjpeg, width, height, 0};
    EXPECT_FALSE(reader.read(format, bytes_of(other.file), luma));
    EXPECT_FALSE(reader.read(format, bytes_of(jpeg.file).first(jpeg.file.size() / 2), luma));
    EXPECT_FALSE(reader.read(format, bytes_of(noisy_ramp(width, height, 1)), luma));
    ASSERT_TRUE(reader.read(format, bytes_of(jpeg.file), luma)) << "and the next good one is read";
    Picture padded = jpeg.file;
    padded.resize(padded.size() + 512);
    EXPECT_TRUE(reader.read(format, bytes_of(padded), luma)) << "cameras pad their frames";
}

} // namespace
} // namespace frustumscreen::camera
