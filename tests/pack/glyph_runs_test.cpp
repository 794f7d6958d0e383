// Glyph runs: the bytes of FORMAT.md, and refusals by the reader.
#include "app/pack/glyph_runs.h"
#include "firmware_host/base/byte_reader.h"
#include "tests/base/told.h"
#include "tests/folders.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <regex>
#include <sstream>

using namespace frustumscreen;
using namespace frustumscreen::pack;

namespace {

GlyphRuns one_text() {
    GlyphRuns runs;
    runs.texels_per_em = 40;
    runs.spread_texels = 4;
    runs.atlas_width = 32;
    runs.atlas_height = 36;
    runs.boxes = {{0, 0, 30, 36, -3, 33}, {30, 0, 0, 0, 0, 0}};
    runs.texts = {
        {"name", TextDirection::RightToLeft, {{9216, 1290, 1395, {{1095, 2}}, {{0, 0, 260}, {1, -16, 0}}}}}};
    return runs;
}

/// The bytes of FORMAT.md's example, typed by hand.
Bytes example_bytes() {
    std::ifstream page(source_dir() + "/app/pack/FORMAT.md");
    std::stringstream text;
    text << page.rdbuf();
    std::string part = text.str();
    part = part.substr(part.find("## Glyph runs"));
    Bytes bytes;
    const std::regex row(R"((?:^|\n)[0-9a-f]{4}  ((?:[0-9a-f]{2} ?)+))");
    for (std::sregex_iterator match(part.begin(), part.end(), row), end; match != end; ++match) {
        std::istringstream numbers((*match)[1].str());
        for (int value = 0; numbers >> std::hex >> value;) {
            bytes.push_back(static_cast<std::byte>(value));
        }
    }
    return bytes;
}

template <typename Number> Bytes with(Bytes bytes, std::size_t at, Number number) {
    std::memcpy(bytes.data() + at, &number, sizeof(number));
    return bytes;
}

std::string refusal(const Bytes& bytes) {
    const Result<GlyphRuns> runs = decode_glyph_runs(bytes);
    return runs ? std::string() : test::told(runs.error());
}

} // namespace

TEST(GlyphRuns, encoding_matches_the_format_page) {
    EXPECT_EQ(encode_glyph_runs(one_text()), example_bytes());
}

TEST(GlyphRuns, decodes_the_example_of_the_format_page) {
    const Result<GlyphRuns> runs = decode_glyph_runs(example_bytes());
    ASSERT_TRUE(runs) << runs.error().message;
    EXPECT_TRUE(*runs == one_text());
}

TEST(GlyphRuns, truncated_or_extended_runs_are_refused) {
    Bytes good = encode_glyph_runs(one_text());
    for (std::size_t bytes = 0; bytes < good.size(); ++bytes) {
        EXPECT_FALSE(decode_glyph_runs(std::span(good).first(bytes))) << bytes;
    }
    good.push_back(std::byte{0});
    EXPECT_TRUE(test::tells(refusal(good), {"1 bytes", "[glyphs.length]"}));
}

TEST(GlyphRuns, numbers_out_of_range_are_named) {
    const Bytes good = encode_glyph_runs(one_text());
    constexpr std::size_t boxes = 24;
    constexpr std::size_t text = boxes + 2 * 12;
    constexpr std::size_t setting = text + 4 + 4;
    EXPECT_TRUE(test::tells(refusal(with(good, 0, 'X')), {"FSGR", "[glyphs.no_magic]"}));
    EXPECT_TRUE(test::tells(refusal(with(good, 4, 2U)), {"2", "[glyphs.version]"}));
    EXPECT_NE(refusal(with(good, 8, std::uint16_t{0})).find("0 texels an em"), std::string::npos);
    EXPECT_NE(refusal(with(good, 12, std::uint16_t{9000})).find("9000 x 36 texels"), std::string::npos);
    EXPECT_NE(refusal(with(good, 16, 0xffffffffU)).find("claims 4294967295 glyphs"), std::string::npos);
    EXPECT_NE(refusal(with(good, 20, 5000U)).find("5000 texts"), std::string::npos);
    EXPECT_TRUE(
        test::tells(refusal(with(good, boxes, std::uint16_t{3})), {"glyph 0", "[glyphs.outside_atlas]"}));
    EXPECT_NE(refusal(with(good, text + 1, std::uint8_t{2})).find("text name has direction 2"),
              std::string::npos);
    EXPECT_NE(refusal(with(good, text + 4, 'N')).find("text 0 has a bad key"), std::string::npos);
    EXPECT_NE(
        refusal(with(good, setting, -1)).find("setting 0 of text name is 1290 x 1395 for a width of -1"),
        std::string::npos);
    EXPECT_NE(refusal(with(good, setting + 12, 100000U)).find("claims 100000 lines"), std::string::npos);
    EXPECT_NE(refusal(with(good, setting + 16, 1U << 30)).find("claims 1 lines and 1073741824 glyphs"),
              std::string::npos);
    EXPECT_NE(refusal(with(good, setting + 24, 3U)).find("has 2 glyphs, and lines for 3"), std::string::npos);
    EXPECT_NE(
        refusal(with(good, setting + 28, std::uint16_t{2})).find("has glyph 2 at 260; there are 2 glyphs"),
        std::string::npos);
}

TEST(GlyphRuns, duplicate_key_is_refused) {
    GlyphRuns twice = one_text();
    twice.texts.push_back(twice.texts[0]);
    EXPECT_TRUE(test::tells(refusal(encode_glyph_runs(twice)), {"text name", "[glyphs.text_twice]"}));
}

TEST(GlyphRuns, atlas_must_be_grey_and_match_their_size) {
    const GlyphRuns runs = one_text();
    const DistanceAtlas right(32, 36, 77);
    const Result<DistanceAtlas> back = decode_distance_atlas(encode_distance_atlas(right), runs);
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->texels, right.texels);
    EXPECT_FALSE(decode_distance_atlas(encode_distance_atlas(DistanceAtlas(31, 36)), runs));
    const Result<DistanceAtlas> coloured =
        decode_distance_atlas(image::encode_webp(image::Image8(32, 36, {1, 2, 3, 255})), runs);
    ASSERT_FALSE(coloured);
    EXPECT_EQ(coloured.error().id, "glyphs.picture_not_grey");
    EXPECT_FALSE(decode_distance_atlas({}, runs));
}
