// Hand-made parts with valid hashes.
#include "tests/base/told.h"
#include "tests/pack/samples.h"

#include <cstring>
#include <functional>
#include <limits>

using namespace frustumscreen;
using namespace frustumscreen::pack;

namespace {

template <typename Number> void set(Bytes& bytes, std::size_t offset, Number value) {
    ASSERT_LE(offset + sizeof value, bytes.size());
    std::memcpy(bytes.data() + offset, &value, sizeof value);
}

struct Hostile {
    const char* part;
    const char* word;
    std::function<void(Bytes&)> change;
};

void expect_refused(const std::vector<Hostile>& cases) {
    const Bytes bytes = samples::bytes_of(samples::pack());
    for (const Hostile& hostile : cases) {
        samples::Entries entries = samples::take_apart(bytes);
        hostile.change(entries.part(hostile.part));
        samples::right_hashes(entries);
        const std::string message = samples::refusal_of(samples::put_together(entries));
        EXPECT_TRUE(samples::is_one_line(message)) << hostile.word << ": " << message;
        EXPECT_NE(message.find(hostile.word), std::string::npos) << hostile.word << ": " << message;
    }
}

constexpr std::size_t header = 24;
constexpr std::size_t cluster = 52;
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr auto u16 = [](int value) { return static_cast<std::uint16_t>(value); };

/// A decompression bomb: the header claims a large picture, with a valid checksum (PNG 1.2, 3.4 and 11.2.2).
void claim_size(Bytes& png, std::uint32_t side) {
    for (std::size_t k = 0; k < 4; ++k) {
        png.at(16 + k) = png.at(20 + k) = static_cast<std::byte>(side >> (24 - 8 * k));
    }
    std::uint32_t crc = 0xFFFFFFFFU;
    for (std::size_t k = 12; k < 29; ++k) {
        crc ^= std::to_integer<std::uint32_t>(png.at(k));
        for (int bit = 0; bit < 8; ++bit) {
            crc = (crc >> 1) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
        }
    }
    for (std::size_t k = 0; k < 4; ++k) {
        png.at(29 + k) = static_cast<std::byte>(~crc >> (24 - 8 * k));
    }
}

/// Offset of a relief level's first vertex.
std::size_t first_texel() {
    const PackLevel level = samples::pack().levels[1];
    return header + level.clusters.size() * cluster + level.indices.size() * 4;
}

} // namespace

TEST(HostilePart, level_whose_header_contradicts_its_size_is_refused) {
    const char* level = "levels/0.bin";
    expect_refused({{level, "bytes is 0", [](Bytes& b) { b.clear(); }},
                    {level, "FSLV", [](Bytes& b) { b[0] = std::byte{'X'}; }},
                    {level, "FSLV", [](Bytes& b) { b.resize(23); }},
                    {level, "version", [](Bytes& b) { set(b, 4, 2U); }},
                    {level, "kind", [](Bytes& b) { set(b, 8, 2U); }},
                    {level, "need", [](Bytes& b) { set(b, 12, 5U); }},
                    {level, "need", [](Bytes& b) { set(b, 16, 0xFFFFFFFFU); }},
                    {level, "need", [](Bytes& b) { set(b, 20, 0x80000001U); }},
                    {level, "need", [](Bytes& b) { b.push_back(std::byte{0}); }},
                    {level, "need", [](Bytes& b) { b.pop_back(); }}});
}

TEST(HostilePart, clusters_cover_the_indices_in_order) {
    const char* level = "levels/0.bin";
    expect_refused({{level, "cluster 0", [](Bytes& b) { set(b, header, 3U); }},
                    {level, "cluster 1", [](Bytes& b) { set(b, header + 4, 3U); }},
                    {level, "cluster 0", [](Bytes& b) { set(b, header + 4, 7U); }},
                    {level, "cluster 1", [](Bytes& b) { set(b, header + cluster + 4, 0U); }},
                    {level, "cover", [](Bytes& b) { set(b, header + cluster + 4, 6U); }},
                    {level, "cluster 1", [](Bytes& b) { set(b, header + cluster, 0xFFFFFFFDU); }},
                    {level, "cluster 0", [](Bytes& b) { set(b, header + 8, not_a_number); }},
                    {level, "cluster 0", [](Bytes& b) { set(b, header + 20, -1.0F); }},
                    {level, "cluster 0", [](Bytes& b) { set(b, header + 24, INFINITY); }},
                    {level, "cluster 1", [](Bytes& b) { set(b, header + cluster + 48, not_a_number); }}});
}

TEST(HostilePart, indices_must_refer_to_existing_vertices) {
    const char* level = "levels/0.bin";
    const std::size_t indices = header + 2 * cluster;
    const std::size_t vertices = indices + 36;
    expect_refused({{level, "index", [=](Bytes& b) { set(b, indices, 4U); }},
                    {level, "index", [=](Bytes& b) { set(b, indices + 32, 0xFFFFFFFFU); }},
                    {level, "reserved", [=](Bytes& b) { set(b, vertices + 6, u16(1)); }}});
}

TEST(HostilePart, a_relief_vertex_lies_on_a_filled_texel_of_its_chart) {
    const char* level = "levels/1.bin";
    const std::size_t texel = first_texel();
    expect_refused({{level, "chart 2", [=](Bytes& b) { set(b, texel, u16(2)); }},
                    {level, "outside", [=](Bytes& b) { set(b, texel, u16(1)); }},
                    {level, "outside", [=](Bytes& b) { set(b, texel + 2, u16(65535)); }},
                    {level, "outside", [=](Bytes& b) { set(b, texel + 4, u16(0)); }},
                    {level, "empty",
                     [=](Bytes& b) {
                         set(b, texel + 2, u16(1));
                         set(b, texel + 4, u16(1));
                     }},
                    {level, "need", [](Bytes& b) { set(b, 8, 0U); }}});
}

TEST(HostilePart, charts_are_disjoint_and_inside_the_atlas) {
    const char* charts = "relief/charts.bin";
    const std::size_t first = 12;
    const std::size_t second = 32;
    expect_refused({{charts, "FSRC", [](Bytes& b) { b.resize(11); }},
                    {charts, "version", [](Bytes& b) { set(b, 4, 9U); }},
                    {charts, "need", [](Bytes& b) { set(b, 8, 0x0CCCCCCEU); }},
                    {charts, "direction", [=](Bytes& b) { set(b, first, u16(6)); }},
                    {charts, "reserved", [=](Bytes& b) { set(b, first + 10, u16(1)); }},
                    {charts, "outside the atlas", [=](Bytes& b) { set(b, first + 2, u16(9)); }},
                    {charts, "outside the atlas", [=](Bytes& b) { set(b, first + 6, u16(65535)); }},
                    {charts, "outside the atlas", [=](Bytes& b) { set(b, second + 8, u16(0)); }},
                    {charts, "overlaps", [=](Bytes& b) { set(b, second + 2, u16(5)); }},
                    {charts, "[atlas.chart_origin]", [=](Bytes& b) { set(b, first + 12, not_a_number); }},
                    {charts, "[atlas.chart_origin]", [=](Bytes& b) { set(b, second + 16, 1e30F); }}});
    samples::Entries entries = samples::take_apart(samples::bytes_of(samples::pack()));
    Bytes& none = entries.part(charts);
    none.resize(12);
    set(none, 8, 0U);
    samples::right_hashes(entries);
    EXPECT_NE(samples::refusal_of(samples::put_together(entries)).find("charts"), std::string::npos);
}

TEST(HostilePart, a_picture_is_a_png_or_webp_of_allowed_size) {
    expect_refused(
        {{"textures/0.png", "PNG", [](Bytes& b) { b.assign(100, std::byte{7}); }},
         {"textures/0.png", "PNG", [](Bytes& b) { b.resize(b.size() / 2); }},
         {"textures/0.png", "WebP", // of a truncated picture
          [](Bytes& b) {
              b = image::encode_webp(samples::texture(13, 7, 1, true));
              b.resize(b.size() / 2);
          }},
         {"textures/0.png", "16000 x 4500",
          [](Bytes& b) { b = image::encode_webp(image::Image8(16000, 4500)); }},
         {"relief/atlas.png", "relief/atlas.png",
          [](Bytes& b) { b = image::encode_png(samples::texture(13, 7, 1, true)); }},
         {"relief/atlas.png", "its texture is",
          [](Bytes& b) { b = image::encode_png(image::Image16(12, 7)); }},
         // 30000 x 2 texels: few, but wider than drivers accept.
         {"textures/0.png", "30000 x 2", [](Bytes& b) { b = image::encode_png(image::Image8(30000, 2)); }},
         {"textures/0.png", "16000 x 16000", [](Bytes& b) { claim_size(b, 16000); }},
         {"relief/atlas.png", "16000 x 16000", [](Bytes& b) { claim_size(b, 16000); }}});
}

TEST(HostilePart, the_writer_refuses_what_the_reader_would) {
    const auto refused = [](const std::function<void(Pack&)>& change) {
        Pack pack = samples::pack();
        change(pack);
        const Result<Bytes> bytes = write_pack(pack);
        return bytes ? std::string() : test::told(bytes.error());
    };
    EXPECT_NE(refused([](Pack& p) { p.title = "\xFF"; }).find("title"), std::string::npos);
    EXPECT_NE(refused([](Pack& p) { p.levels.clear(); }).find("levels"), std::string::npos);
    EXPECT_NE(refused([](Pack& p) { p.levels[0].indices[3] = 99; }).find("level 0"), std::string::npos);
    EXPECT_NE(refused([](Pack& p) { p.levels[0].error.p95_box = not_a_number; }).find("error"),
              std::string::npos);
    EXPECT_NE(refused([](Pack& p) { p.textures[1] = image::Image8(13, 6); }).find("13 x 6"),
              std::string::npos);
    EXPECT_NE(refused([](Pack& p) { p.textures[0] = image::Image8(); }).find("texture 0"), std::string::npos);
    EXPECT_NE(refused([](Pack& p) { p.relief.charts[1].x = 3; }).find("overlaps"), std::string::npos);
    EXPECT_NE(refused([](Pack& p) { p.levels[1].vertices[0].uv[0] = 7; }).find("centre"), std::string::npos);
    EXPECT_NE(refused([](Pack& p) { p.levels[1].vertices[0].position[0] ^= 0x4000U; }).find("vertex 0"),
              std::string::npos);
    EXPECT_NE(refused([](Pack& p) { p.extremes.clear(); }).find("extremes"), std::string::npos);
    EXPECT_NE(refused([](Pack& p) {
                  p.levels.pop_back();
                  p.default_level = 0;
              }).find("[pack.unused_relief]"),
              std::string::npos);
}
