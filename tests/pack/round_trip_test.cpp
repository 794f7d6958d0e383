#include "app/pack/pack_contents.h"
#include "app/pack/relief_texel.h"
#include "tests/folders.h"
#include "tests/pack/samples.h"
#include "tests/pack/zip_dates.h"

#include <algorithm>
#include <filesystem>

using namespace frustumscreen;
using namespace frustumscreen::pack;

namespace {

bool same(const PackCluster& a, const PackCluster& b) {
    return a.first_index == b.first_index && a.index_count == b.index_count && a.centre == b.centre &&
           a.radius == b.radius && a.cone_apex == b.cone_apex && a.cone_axis == b.cone_axis &&
           a.cone_cutoff == b.cone_cutoff;
}

void expect_same(const PackLevel& a, const PackLevel& b) {
    EXPECT_EQ(a.technique, b.technique);
    EXPECT_EQ(a.texture, b.texture);
    EXPECT_EQ(a.error.mean_box, b.error.mean_box);
    EXPECT_EQ(a.error.p95_box, b.error.p95_box);
    EXPECT_EQ(a.error.max_box, b.error.max_box);
    EXPECT_EQ(a.error.colour_rmse, b.error.colour_rmse);
    EXPECT_EQ(a.indices, b.indices);
    ASSERT_EQ(a.vertices.size(), b.vertices.size());
    for (std::size_t k = 0; k < a.vertices.size(); ++k) {
        EXPECT_EQ(a.vertices[k].position, b.vertices[k].position) << k;
        EXPECT_EQ(a.vertices[k].uv, b.vertices[k].uv) << k;
    }
    ASSERT_EQ(a.clusters.size(), b.clusters.size());
    for (std::size_t k = 0; k < a.clusters.size(); ++k) {
        EXPECT_TRUE(same(a.clusters[k], b.clusters[k])) << k;
    }
}

void expect_same(const ReliefAtlas& a, const ReliefAtlas& b) {
    EXPECT_EQ(a.texel_box, b.texel_box);
    EXPECT_EQ(a.relief.width, b.relief.width);
    EXPECT_EQ(a.relief.texels, b.relief.texels);
    ASSERT_EQ(a.charts.size(), b.charts.size());
    for (std::size_t k = 0; k < a.charts.size(); ++k) {
        const ReliefChart& p = a.charts[k];
        const ReliefChart& q = b.charts[k];
        EXPECT_TRUE(p.direction == q.direction && p.x == q.x && p.y == q.y && p.width == q.width &&
                    p.height == q.height && p.u0_box == q.u0_box && p.v0_box == q.v0_box)
            << k;
    }
}

void expect_same(const Pack& a, const Pack& b) {
    EXPECT_TRUE(static_cast<const PackDescription&>(a) == b);
    ASSERT_EQ(a.textures.size(), b.textures.size());
    for (std::size_t k = 0; k < a.textures.size(); ++k) {
        EXPECT_EQ(a.textures[k].width, b.textures[k].width);
        EXPECT_EQ(a.textures[k].texels, b.textures[k].texels);
    }
    expect_same(a.relief, b.relief);
    EXPECT_EQ(a.table_picture.width, b.table_picture.width);
    EXPECT_EQ(a.table_picture.texels, b.table_picture.texels);
    EXPECT_EQ(a.section_parts, b.section_parts);
    ASSERT_EQ(a.levels.size(), b.levels.size());
    for (std::size_t k = 0; k < a.levels.size(); ++k) {
        expect_same(a.levels[k], b.levels[k]);
    }
}

} // namespace

TEST(RoundTrip, everything_in_a_pack_comes_back_unchanged) {
    const Pack pack = samples::pack();
    const Result<VerifiedPack> back = verify_pack(samples::bytes_of(pack));
    ASSERT_TRUE(back) << back.error().message;
    expect_same(pack, **back);
}

TEST(RoundTrip, sections_come_back_unchanged) {
    const Pack pack = samples::full_pack();
    const Bytes bytes = samples::bytes_of(pack);
    const Result<VerifiedPack> back = verify_pack(bytes);
    ASSERT_TRUE(back) << back.error().message;
    expect_same(pack, **back);
    EXPECT_EQ(samples::bytes_of(**back), bytes);
}

TEST(RoundTrip, rewriting_a_pack_gives_the_same_bytes) {
    const Bytes bytes = samples::bytes_of(samples::pack());
    const Result<VerifiedPack> back = verify_pack(bytes);
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(samples::bytes_of(**back), bytes);
}

TEST(RoundTrip, the_manifest_has_the_fields_of_the_format_page) {
    const samples::Entries entries = samples::take_apart(samples::bytes_of(samples::pack()));
    EXPECT_EQ(entries.manifest["provenance"].dump(),
              R"({"source_name":"amphora.glb","source_sha256":")" + std::string(64, 'a') +
                  R"(","licence":"CC0-1.0","source_triangles":123456789012})");
    std::vector<std::string> names;
    for (const auto& [name, value] : entries.manifest.items()) {
        names.push_back(name);
    }
    EXPECT_EQ(names,
              (std::vector<std::string>{"format", "version", "title", "languages", "captions", "provenance",
                                        "prop_kind", "unlit", "samples", "relief_size", "placement",
                                        "textures", "relief", "levels", "default_level", "parts"}));
}

TEST(RoundTrip, an_outline_has_all_of_the_description) {
    const Pack pack = samples::pack();
    const PackOutline outline = outline_of(pack);
    EXPECT_EQ(outline.description.provenance, pack.provenance);
    EXPECT_TRUE(outline.description == pack);
}

TEST(RoundTrip, a_pack_of_meshes_needs_no_relief) {
    Pack pack = samples::pack();
    pack.levels.pop_back();
    pack.relief = {};
    pack.textures.pop_back();
    pack.default_level = 0;
    const Result<VerifiedPack> back = verify_pack(samples::bytes_of(pack));
    ASSERT_TRUE(back) << back.error().message;
    expect_same(pack, **back);
}

TEST(RoundTrip, a_texture_is_stored_as_webp_where_that_is_smaller) {
    Pack pack = samples::pack();
    pack.textures[0] = image::Image8(300, 200, {10, 20, 30, 255});
    pack.textures[0].at(7, 9) = {1, 2, 3, 0};
    const Bytes bytes = samples::bytes_of(pack);
    EXPECT_EQ(samples::take_apart(bytes).manifest["textures"][0], "textures/0.webp");
    const Result<VerifiedPack> back = verify_pack(bytes);
    ASSERT_TRUE(back) << back.error().message;
    expect_same(pack, **back);
}

/// The file has the same pack, written by the last program of version 1.
TEST(RoundTrip, a_pack_of_version_1_is_read) {
    const Result<Bytes> file = read_file(source_dir() + "/tests/pack/fixtures/version1.fspack");
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(samples::take_apart(*file).manifest["version"], 1);
    const Result<VerifiedPack> back = verify_pack(*file);
    ASSERT_TRUE(back) << back.error().message;
    expect_same(samples::pack(), **back);
}

TEST(RoundTrip, errors_of_any_size_keep_all_their_bits) {
    std::mt19937 random(5);
    for (int k = 0; k < 50; ++k) {
        Pack pack = samples::pack();
        std::uniform_real_distribution<float> exponent(-30.0F, 0.0F);
        pack.levels[0].error.mean_box = std::exp2(exponent(random));
        pack.levels[0].error.p95_box = std::exp2(exponent(random));
        pack.levels[1].error.colour_rmse = 255.0F * std::exp2(exponent(random));
        const Result<VerifiedPack> back = verify_pack(samples::bytes_of(pack));
        ASSERT_TRUE(back) << back.error().message;
        expect_same(pack, **back);
    }
}

TEST(RoundTrip, same_pack_gives_the_same_bytes_with_fixed_dates) {
    const Bytes file = samples::bytes_of(samples::pack());
    EXPECT_EQ(file, samples::bytes_of(samples::pack()));
    const std::vector<std::uint32_t> dates = samples::zip_dates(file);
    ASSERT_FALSE(dates.empty());
    for (const std::uint32_t date : dates) {
        EXPECT_EQ(date, samples::earliest_zip_date);
    }
}

TEST(RoundTrip, relief_vertex_is_snapped_to_its_texel) {
    Pack pack = samples::pack();
    const Bytes exact = samples::bytes_of(pack);
    for (PackVertex& vertex : pack.levels[1].vertices) {
        vertex.uv[0] = static_cast<std::uint16_t>(vertex.uv[0] + 1);
        vertex.position[2] =
            static_cast<std::uint16_t>(vertex.position[2] + (vertex.position[2] > 9 ? -1 : 1));
    }
    EXPECT_EQ(samples::bytes_of(pack), exact);
}

TEST(RoundTrip, uv_codes_identify_each_texel_of_a_wide_atlas) {
    for (const int width : {1, 3, 1023, 4096, 16384}) {
        for (int x = 0; x < width; ++x) {
            const std::uint16_t code = uv_code(x, width);
            ASSERT_EQ(std::floor(code / 65535.0 * width), x) << width;
        }
    }
}

TEST(RoundTrip, a_relief_level_stores_its_vertices_as_texels) {
    const samples::Entries entries = samples::take_apart(samples::bytes_of(samples::pack()));
    const PackLevel level = samples::pack().levels[1];
    const auto part =
        std::ranges::find_if(entries.parts, [](const auto& each) { return each.first == "levels/1.bin"; });
    ASSERT_NE(part, entries.parts.end());
    EXPECT_EQ(part->second.size(),
              24 + 52 * level.clusters.size() + 4 * level.indices.size() + 6 * level.vertices.size());
}

TEST(RoundTrip, a_file_is_read_and_named_in_errors) {
    const std::filesystem::path file = "round_trip.fspack";
    Bytes bytes = samples::bytes_of(samples::pack());
    ASSERT_TRUE(write_file(file, bytes));
    EXPECT_TRUE(load_pack(file));
    bytes.resize(bytes.size() / 2);
    ASSERT_TRUE(write_file(file, bytes));
    const Result<VerifiedPack> back = load_pack(file);
    ASSERT_FALSE(back);
    EXPECT_EQ(back.error().message.find("round_trip.fspack: "), 0U);
    std::filesystem::remove(file);
    EXPECT_FALSE(load_pack(file));
}

TEST(RoundTrip, parts_are_listed_with_their_sizes) {
    const Bytes bytes = samples::bytes_of(samples::pack());
    const auto parts = list_pack_parts(bytes);
    ASSERT_TRUE(parts);
    ASSERT_EQ(parts->size(), 7U);
    EXPECT_EQ(parts->front().name, "manifest.json");
    std::uint64_t stored = 0;
    for (const PackPart& part : *parts) {
        stored += part.stored_bytes;
    }
    EXPECT_LT(stored, bytes.size());
}
