/// Small packs made in memory, and functions that take packs apart and put them together again with correct
/// hashes.
#pragma once

#include "app/pack/container/sha256.h"
#include "app/pack/container/zip_archive.h"
#include "app/pack/manifest.h"
#include "app/pack/pack_file.h"
#include "app/pack/pack_relief.h"
#include "app/pack/pack_texts.h"
#include "firmware_host/base/json.h"
#include "tests/base/told.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <stdexcept>
#include <string>

namespace frustumscreen::samples {

/// One quad in the plane z = 1/4 of the box and one upright, in two clusters.
inline pack::PackLevel mesh_level() {
    pack::PackLevel level;
    level.technique = pack::LevelTechnique::Mesh;
    level.error = {0.0001F, 0.0004F, 0.02F, 3.5F};
    level.vertices = {{{0, 0, 16384}, 0, {0, 0}},
                      {{65535, 0, 16384}, 0, {65535, 0}},
                      {{65535, 65535, 16384}, 0, {65535, 65535}},
                      {{0, 65535, 65535}, 0, {0, 65535}}};
    level.indices = {0, 1, 2, 0, 2, 3, 2, 1, 3};
    pack::PackCluster first{0, 6, {0.0F, 0.0F, 0.2F}, 0.75F, {0.1F, -0.2F, 0.3F}, {0.0F, 0.6F, 0.8F}, 0.25F};
    pack::PackCluster second{6, 3, {0.25F, 0.0F, 0.5F}, 0.5F, {0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}, 2.0F};
    level.clusters = {first, second};
    return level;
}

/// Two charts, one seen from above and one from the front, with an empty texel in each.
inline pack::ReliefAtlas relief_atlas() {
    pack::ReliefAtlas atlas;
    atlas.texel_box = 0.125F;
    atlas.charts = {{pack::ReliefDirection::PlusZ, 1, 1, 5, 4, -0.4375F, -0.1875F},
                    {pack::ReliefDirection::MinusY, 8, 2, 3, 3, -0.25F, 0.0625F}};
    atlas.relief = image::Image16(13, 7, 65535);
    for (const pack::ReliefChart& chart : atlas.charts) {
        for (int y = chart.y; y < chart.y + chart.height; ++y) {
            for (int x = chart.x; x < chart.x + chart.width; ++x) {
                atlas.relief.at(x, y) = static_cast<std::uint16_t>((x * 9001 + y * 17011) % 65535);
            }
        }
    }
    atlas.relief.at(1, 1) = 65535;
    atlas.relief.at(10, 4) = 65535;
    return atlas;
}

/// Where a texel lies according to pack.h, written out for the two directions used here.
inline pack::PackVertex vertex_at(const pack::ReliefAtlas& atlas, const pack::ReliefChart& chart, int x,
                                  int y, const glm::dvec3& box) {
    const double u = static_cast<double>(chart.u0_box) + 0.125 * (x - chart.x);
    const double v = static_cast<double>(chart.v0_box) + 0.125 * (y - chart.y);
    const double along = atlas.relief.at(x, y) / 65534.0;
    const glm::dvec3 unit = chart.direction == pack::ReliefDirection::PlusZ
                                ? glm::dvec3(u / box.x + 0.5, v / box.y + 0.5, along)
                                : glm::dvec3(u / box.x + 0.5, along, v / box.z);
    const auto code = [](double value) { return static_cast<std::uint16_t>(std::lround(value * 65535.0)); };
    return {{code(unit.x), code(unit.y), code(unit.z)}, 0, {code((x + 0.5) / 13.0), code((y + 0.5) / 7.0)}};
}

/// A triangle for every texel whose right and lower neighbours are filled too.
inline pack::PackLevel relief_level(const pack::ReliefAtlas& atlas, const glm::dvec3& box) {
    pack::PackLevel level;
    level.technique = pack::LevelTechnique::Relief;
    level.error = {0.001F, 0.002F, 0.003F, 12.25F};
    level.texture = 1;
    for (const pack::ReliefChart& chart : atlas.charts) {
        const auto first = static_cast<std::uint32_t>(level.indices.size());
        for (int y = chart.y; y + 1 < chart.y + chart.height; ++y) {
            for (int x = chart.x; x + 1 < chart.x + chart.width; ++x) {
                if (atlas.relief.at(x, y) == 65535 || atlas.relief.at(x + 1, y) == 65535 ||
                    atlas.relief.at(x, y + 1) == 65535) {
                    continue;
                }
                for (const auto& [i, j] : {std::pair(x, y), std::pair(x + 1, y), std::pair(x, y + 1)}) {
                    level.indices.push_back(static_cast<std::uint32_t>(level.vertices.size()));
                    level.vertices.push_back(vertex_at(atlas, chart, i, j, box));
                }
            }
        }
        pack::PackCluster cluster;
        cluster.first_index = first;
        cluster.index_count = static_cast<std::uint32_t>(level.indices.size()) - first;
        cluster.radius = 1.5F;
        level.clusters.push_back(cluster);
    }
    return level;
}

inline image::Image8 texture(int width, int height, unsigned seed, bool opaque) {
    std::mt19937 random(seed);
    image::Image8 image(width, height);
    for (glm::u8vec4& texel : image.texels) {
        const auto code = static_cast<std::uint32_t>(random());
        texel = {code & 255U, (code >> 8) & 255U, (code >> 16) & 255U, opaque ? 255U : code >> 24};
    }
    return image;
}

/// A pack without sections: levels of both kinds, in few bytes.
inline pack::Pack pack() {
    pack::Pack pack;
    pack.title = "Amphora \xC3\xA0 colonnettes";
    pack.languages = {"en", "pt-BR"};
    pack.captions = {{"en", "Amphora", "Clay, wheel-made.\nAbout 540 BC."}, {"pt-BR", "\xC3\x82nfora", ""}};
    pack.provenance = {"amphora.glb", std::string(64, 'a'), "CC0-1.0", 123456789012ULL};
    pack.prop_kind = "frustum";
    pack.unlit = true;
    pack.samples = 2;
    pack.relief_size = 512;
    pack.box_size = {1.0, 0.5, 0.8};
    pack.box_from_file = glm::translate(glm::dmat4(1.0), glm::dvec3(0.1, -1.0 / 3.0, 0.7)) *
                         glm::rotate(glm::dmat4(1.0), 0.3, glm::normalize(glm::dvec3(1.0, 2.0, -0.5))) *
                         glm::scale(glm::dmat4(1.0), glm::dvec3(1.0 / 7.0));
    pack.extremes = {{-0.5, 0.1, 0.0}, {0.5, -0.25, 0.3}, {0.1, 0.25, 0.8}, {1.0 / 3.0, 0.0, 0.5}};
    pack.textures = {texture(9, 5, 1, true), texture(13, 7, 2, false)};
    pack.relief = relief_atlas();
    pack.levels = {mesh_level(), relief_level(pack.relief, pack.box_size)};
    pack.default_level = 1;
    return pack;
}

inline Bytes some_bytes(std::string_view text) {
    const auto bytes = as_bytes(text);
    return {bytes.begin(), bytes.end()};
}

/// A pack with every section that the description has members for, an unknown section, and sounds.
inline pack::Pack full_pack() {
    pack::Pack pack = samples::pack();
    pack.id = "museum-1234.a";
    pack.captions[0].period = "about 540 BC";
    pack.captions[0].place = "Athens";
    pack.captions[0].maker = "the Amasis painter (?)";
    pack.captions[0].credit = "Gift of N.N.";
    pack.captions[0].description = "A jar, as high as a hand.\nTwo handles.";
    pack.captions[1].place = "Atenas";
    pack.hotspots = {{{0.25, -0.125, 0.5},
                      {0.0, -0.6, 0.8},
                      {{"en", "The handle"},
                       {"pt-BR", "A al\xC3\xA7"
                                 "a"}}},
                     {{-0.5, 0.0, 0.0}, {-1.0, 0.0, 0.0}, {{"en", "The foot"}}}};
    pack.table_picture = texture(31, 17, 3, false);
    pack.sections = {
        {"glyphs", R"({"size":12.5})", {"glyphs/runs.bin", "glyphs/atlas.png"}},
        {"sounds",
         R"({"languages":[{"language":"en","sounds":[{"key":"description","part":"sounds/en/0.opus"}]},)"
         R"({"language":"pt-BR","sounds":[{"key":"description","part":"sounds/pt-br/0.opus"}]}]})",
         {"sounds/en/0.opus", "sounds/pt-br/0.opus"}}};
    pack.section_parts = {{"glyphs/runs.bin", some_bytes("runs")},
                          {"glyphs/atlas.png", some_bytes("no picture; nobody looks")},
                          {"sounds/en/0.opus", some_bytes("OggS english")},
                          {"sounds/pt-br/0.opus", some_bytes("OggS portuguese")}};
    return pack;
}

/// One letter, a block of 3 x 4 texels, in a title that is broken for one width.
inline pack::SetLanguage set_language(const std::string& language, pack::TextDirection direction) {
    pack::SetLanguage set{language, {}, pack::DistanceAtlas(5, 6, 255)};
    set.runs.texels_per_em = 8;
    set.runs.spread_texels = 1;
    set.runs.atlas_width = 5;
    set.runs.atlas_height = 6;
    set.runs.boxes = {{1, 1, 3, 4, 0, 4}};
    set.runs.texts = {{"title", direction, {{4096, 512, 1024, {{800, 1}}, {{0, 0, 64}}}}}};
    return set;
}

/// Texts in three languages, one of them without letters, and a sound.
inline pack::Pack pack_with_words() {
    pack::Pack pack = samples::pack();
    pack::SetLanguage without_letters = set_language("fr", pack::TextDirection::LeftToRight);
    without_letters.atlas = {};
    without_letters.runs.atlas_width = without_letters.runs.atlas_height = 0;
    without_letters.runs.boxes = {{}};
    pack::put_sounds(pack, std::vector<pack::SpokenLanguage>{
                               {"en", {{"description", some_bytes("OggS english")}}}, {"fr", {}}});
    pack::put_set_texts(pack, std::vector{set_language("en", pack::TextDirection::LeftToRight),
                                          set_language("pt-BR", pack::TextDirection::RightToLeft),
                                          without_letters, pack::SetLanguage{"de", {}, {}}});
    return pack;
}

/// Blocks of a hill in two directions, of `texels`: one whole, one with cells left out, one of a single cell.
inline relief::BlockRelief block_relief(int texels) {
    relief::BlockRelief relief;
    relief.texel_box = static_cast<float>(1.0 / texels);
    relief.grids = {{{1, 2, 0}, -1.0, {-0.5, -0.25 - 0.5 / texels, -0.5 / texels}},
                    {{0, 1, 2}, 1.0, {-0.5 - 0.5 / texels, -0.25 - 0.5 / texels, 0.0}}};
    relief.first_block = {0, 1, 3};
    const auto add = [&](int u0, int v0, float w0, std::uint64_t mask, std::array<std::uint8_t, 4> cells) {
        relief::ReliefBlock block;
        block.u0 = static_cast<float>(u0);
        block.v0 = static_cast<float>(v0);
        block.w0 = w0;
        block.w_u = 0.25F;
        block.w_v = -0.125F;
        block.residual_low = -0.5F;
        block.residual_step = 0.0039F;
        block.gradient_u = {-0.2F, 0.3F};
        block.gradient_v = {-0.25F, 0.1F};
        block.mask = mask;
        block.cells = cells;
        block.cut = mask & 0x0000'0004'0008'0000U;
        block.first_cover = static_cast<std::uint32_t>(relief.covers.size());
        for (std::uint64_t left = block.cut; left != 0; left &= left - 1) {
            relief.covers.push_back(0x0103'070F'1F3F'7FFFU + relief.covers.size());
        }
        const auto code = [&](std::uint32_t i, std::uint32_t j) {
            return (40 + 12 * i + 7 * j + static_cast<std::uint32_t>(u0)) & 255U;
        };
        for (std::uint32_t j = 0; j < 8; ++j) {
            for (std::uint32_t i = 0; i < 8; ++i) {
                relief.corner_codes.push_back(code(i, j) | code(i + 1, j) << 8U | code(i, j + 1) << 16U |
                                              code(i + 1, j + 1) << 24U);
            }
        }
        for (std::uint32_t k = 0; k < 81; ++k) {
            relief.colours.emplace_back(200 - k, 3 * k, k * k & 255U, 255);
        }
        relief.blocks.push_back(block);
    };
    add(0, 8, 20.5F, 0x0000'0000'0008'0000U, {3, 4, 2, 3});
    add(8, 0, 12.0F, ~std::uint64_t{0}, {0, 8, 0, 8});
    add(16, 8, 9.0F, 0x0000'003C'7E00'0000U, {1, 7, 3, 5});
    return relief;
}

/// A pack with two reliefs and its levels.
inline pack::Pack pack_with_reliefs() {
    pack::Pack pack = samples::pack();
    pack::put_reliefs(pack,
                      std::vector<pack::MeasuredRelief>{{block_relief(32), {0.01F, 0.02F, 0.03F, 4.5F}},
                                                        {block_relief(64), {0.001F, 0.002F, 0.25F, 0.0F}}});
    return pack;
}

inline Bytes bytes_of(const pack::Pack& pack) {
    Result<Bytes> bytes = pack::write_pack(pack);
    EXPECT_TRUE(bytes) << (bytes ? "" : bytes.error().message);
    return bytes ? *bytes : Bytes{};
}

/// A pack's entries, to be altered and reassembled.
struct Entries {
    // A JSON document's own constructors may throw.
    Entries() noexcept(false) = default;
    Entries(Entries&&) noexcept(false) = default;
    Entries(const Entries&) = default;
    Entries& operator=(const Entries&) = default;
    ~Entries() = default;

    nlohmann::ordered_json manifest;
    std::vector<std::pair<std::string, Bytes>> parts;

    Bytes& part(const std::string& name) {
        for (auto& [part_name, bytes] : parts) {
            if (part_name == name) {
                return bytes;
            }
        }
        throw std::out_of_range(name);
    }
};

/// Throws if the bytes are no pack: a fuzzer's bytes may claim any size.
inline Entries take_apart(const Bytes& bytes) {
    constexpr std::uint64_t max_bytes = 1U << 28U;
    auto zip = pack::ZipReader::open(bytes);
    Entries entries;
    for (const pack::ZipEntry& entry : zip.value().entries()) {
        if (entry.bytes > max_bytes) {
            throw std::length_error(entry.name);
        }
        const Bytes part = zip->read(entry).value();
        if (entry.name == pack::manifest_name) {
            entries.manifest = nlohmann::ordered_json::parse(as_text(part));
        } else {
            entries.parts.push_back({entry.name, part});
        }
    }
    return entries;
}

/// Packs the parts unchanged, with this text as the manifest.
inline Bytes put_together(const std::string& manifest,
                          const std::vector<std::pair<std::string, Bytes>>& parts) {
    pack::ZipWriter zip;
    zip.add("manifest.json", as_bytes(manifest), pack::Packing::Deflated);
    for (const auto& [name, bytes] : parts) {
        zip.add(name, bytes, pack::Packing::Stored);
    }
    return zip.finish().value();
}
inline Bytes put_together(const Entries& entries) {
    return put_together(entries.manifest.dump(), entries.parts);
}

/// Sets the sizes and hashes in the manifest to those of the parts.
inline void right_hashes(Entries& entries) {
    for (auto& record : entries.manifest["parts"]) {
        for (const auto& [name, bytes] : entries.parts) {
            if (record["name"] == name) {
                record["bytes"] = bytes.size();
                record["sha256"] = pack::sha256_hex(bytes);
            }
        }
    }
}

/// The message with which the bytes are refused; empty if they are accepted.
inline std::string refusal_of(const Bytes& bytes) {
    const Result<pack::VerifiedPack> pack = pack::verify_pack(bytes);
    return pack ? std::string() : test::told(pack.error());
}

/// One line for a person: not empty, one line, short, no control characters.
inline bool is_one_line(const std::string& message) {
    return !message.empty() && message.size() < 400 && message.find('\n') == std::string::npos &&
           message.find('\x1b') == std::string::npos && message.find('\0') == std::string::npos;
}

} // namespace frustumscreen::samples
