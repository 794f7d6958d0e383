// Common properties of PNG and lossless WebP: every texel survives, and invalid bytes are refused.

#include "tests/image/pictures.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

using namespace frustumscreen;
using namespace frustumscreen::image;

namespace {

struct Codec {
    const char* name;
    Bytes (*encode)(const Image8&);
    Result<Image8> (*decode)(std::span<const std::byte>, std::int64_t max_pixels);
    std::size_t tail; ///< bytes at the end that contain no part of the picture
    std::string (*chunks)(const Bytes&);
    const char* expected_chunks; ///< each chunk's name, repeated chunks once
};

/// The names of a file's chunks from `at` on. `foot`: number of bytes after a chunk's data.
template <typename Length>
std::string chunk_names(const Bytes& bytes, std::size_t at, std::size_t name_at, std::size_t foot,
                        const Length& length_at) {
    std::string names;
    std::string last;
    while (at + 8 <= bytes.size()) {
        const std::string name(as_text(std::span(bytes).subspan(at + name_at, 4)));
        names += name == last ? "" : name + " ";
        last = name;
        at += 8 + length_at(at) + foot;
    }
    return names;
}
/// Source  ISO/IEC 15948: length, name, bytes, checksum
std::string png_chunks(const Bytes& bytes) {
    return chunk_names(bytes, 8, 4, 4, [&](std::size_t at) {
        std::size_t length = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            length = length << 8U | std::to_integer<std::size_t>(bytes[at + k]);
        }
        return length;
    });
}
/// Source  RFC 9649: name, length, bytes to an even count
std::string webp_chunks(const Bytes& bytes) {
    return chunk_names(bytes, 12, 0, 0, [&](std::size_t at) {
        std::size_t length = 0;
        for (std::size_t k = 4; k-- > 0;) {
            length = length << 8U | std::to_integer<std::size_t>(bytes[at + 4 + k]);
        }
        return length + length % 2;
    });
}

constexpr std::int64_t plenty = 1 << 20; ///< pixels

class Lossless : public ::testing::TestWithParam<Codec> {
protected:
    const Codec& codec_ = GetParam();
};

} // namespace

TEST_P(Lossless, round_trip_keeps_every_texel_with_alpha) {
    for (const Image8& image :
         {noise(61, 37, false), noise(61, 37, true), smooth(200, 100), noise(1, 1, true)}) {
        const Result<Image8> back = codec_.decode(codec_.encode(image), plenty);
        ASSERT_TRUE(back) << back.error().message;
        EXPECT_EQ(back->width, image.width);
        EXPECT_EQ(back->height, image.height);
        EXPECT_EQ(back->texels, image.texels);
    }
}

/// No time stamp and no program name: equal pictures give equal bytes.
TEST_P(Lossless, output_is_deterministic_with_only_expected_chunks) {
    const Image8 image = noise(20, 30, true);
    const Bytes bytes = codec_.encode(image);
    EXPECT_EQ(bytes, codec_.encode(image));
    EXPECT_EQ(codec_.chunks(bytes), codec_.expected_chunks);
}

TEST_P(Lossless, a_picture_without_texels_gives_no_bytes) {
    EXPECT_TRUE(codec_.encode(Image8()).empty());
}

TEST_P(Lossless, a_picture_above_the_limit_is_refused_before_it_is_decoded) {
    const Bytes bytes = codec_.encode(noise(64, 64, false));
    EXPECT_TRUE(codec_.decode(bytes, 4096));
    const Result<Image8> back = codec_.decode(bytes, 4095);
    ASSERT_FALSE(back);
    EXPECT_NE(back.error().message.find("64 x 64"), std::string::npos);
}

TEST_P(Lossless, every_truncation_is_refused) {
    const Bytes bytes = codec_.encode(noise(16, 16, true));
    for (std::size_t size = 0; size + codec_.tail < bytes.size(); ++size) {
        const Result<Image8> back = codec_.decode(std::span(bytes).first(size), plenty);
        ASSERT_FALSE(back) << size;
        EXPECT_EQ(back.error().message.find('\n'), std::string::npos);
    }
}

TEST_P(Lossless, altered_bytes_never_crash) {
    const Bytes bytes = codec_.encode(noise(16, 16, true));
    std::mt19937 random(3);
    for (int k = 0; k < 2000; ++k) {
        Bytes altered = bytes;
        altered[random() % altered.size()] ^= static_cast<std::byte>(1U << (random() % 8));
        if (const Result<Image8> back = codec_.decode(altered, plenty); back) {
            ASSERT_EQ(back->texels.size(),
                      static_cast<std::size_t>(back->width) * static_cast<std::size_t>(back->height));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Codecs, Lossless,
                         ::testing::Values(Codec{"Png", encode_png, decode_png8, 12, // the chunk IEND
                                                 png_chunks, "IHDR sRGB IDAT IEND "},
                                           Codec{"WebP", encode_webp, decode_webp8, 4, webp_chunks, "VP8L "}),
                         [](const auto& info) { return std::string(info.param.name); });
