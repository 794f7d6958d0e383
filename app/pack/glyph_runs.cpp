#include "app/pack/glyph_runs.h"

#include "firmware_host/base/byte_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <set>

namespace frustumscreen::pack {

namespace {

using namespace glyph_limits;

constexpr std::array<char, 4> magic{'F', 'S', 'G', 'R'};
constexpr std::uint32_t version = 1;
constexpr std::size_t header_bytes = 24;
constexpr std::size_t box_bytes = 12;
constexpr std::size_t line_bytes = 8;
constexpr std::size_t glyph_bytes = 8;

bool is_side(std::int32_t units) {
    return units >= 0 && units <= max_side;
}
bool is_place(std::int32_t units) {
    return units >= -max_side && units <= 2 * max_side;
}

void append_setting(Bytes& bytes, const GlyphSetting& setting) {
    append(bytes, setting.limit);
    append(bytes, setting.width);
    append(bytes, setting.height);
    append(bytes, static_cast<std::uint32_t>(setting.lines.size()));
    append(bytes, static_cast<std::uint32_t>(setting.glyphs.size()));
    for (const GlyphLine& line : setting.lines) {
        append(bytes, line.baseline);
        append(bytes, line.glyphs);
    }
    for (const PlacedGlyph& glyph : setting.glyphs) {
        append(bytes, glyph.glyph);
        append(bytes, glyph.up);
        append(bytes, glyph.x);
    }
}

Result<GlyphRuns> read_header(ByteReader& reader, std::size_t& boxes, std::size_t& texts) {
    GlyphRuns runs;
    runs.texels_per_em = reader.read<std::uint16_t>();
    runs.spread_texels = reader.read<std::uint16_t>();
    runs.atlas_width = reader.read<std::uint16_t>();
    runs.atlas_height = reader.read<std::uint16_t>();
    boxes = reader.read<std::uint32_t>();
    texts = reader.read<std::uint32_t>();
    if (runs.texels_per_em < 1 || runs.texels_per_em > max_texels_per_em || runs.spread_texels < 1 ||
        runs.spread_texels > max_spread_texels) {
        return bad_input(
            "glyphs.scale",
            "its glyphs have {} texels an em and a spread of {}; allowed are 1 to {} and 1 to {}",
            runs.texels_per_em, runs.spread_texels, max_texels_per_em, max_spread_texels);
    }
    if (runs.atlas_width > max_atlas_side || runs.atlas_height > max_atlas_side ||
        std::int64_t{runs.atlas_width} * runs.atlas_height > max_atlas_texels) {
        return bad_input("glyphs.atlas_size",
                         "its atlas has {} x {} texels; allowed are {} a side and {} in all",
                         runs.atlas_width, runs.atlas_height, max_atlas_side, max_atlas_texels);
    }
    if (boxes > max_boxes || texts > max_texts || boxes * box_bytes > reader.left()) {
        return bad_input("glyphs.counts",
                         "it claims {} glyphs and {} texts in {} bytes; allowed are {} and {}", boxes, texts,
                         reader.left(), max_boxes, max_texts);
    }
    return runs;
}

Result<void> read_boxes(ByteReader& reader, std::size_t count, GlyphRuns& runs) {
    runs.boxes.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
        GlyphBox& box = runs.boxes[k];
        box.x = reader.read<std::uint16_t>();
        box.y = reader.read<std::uint16_t>();
        box.width = reader.read<std::uint16_t>();
        box.height = reader.read<std::uint16_t>();
        box.left = reader.read<std::int16_t>();
        box.top = reader.read<std::int16_t>();
        if (box.x + box.width > runs.atlas_width || box.y + box.height > runs.atlas_height) {
            return bad_input("glyphs.outside_atlas", "glyph {} lies outside the atlas", k);
        }
    }
    return {};
}

/// Checks that the bytes of the lines and glyphs are there before it allocates memory for them.
Result<GlyphSetting> read_setting(ByteReader& reader, std::size_t boxes) {
    GlyphSetting setting;
    setting.limit = reader.read<std::int32_t>();
    setting.width = reader.read<std::int32_t>();
    setting.height = reader.read<std::int32_t>();
    const std::size_t lines = reader.read<std::uint32_t>();
    const std::size_t glyphs = reader.read<std::uint32_t>();
    if (!is_side(setting.limit) || !is_side(setting.width) || !is_side(setting.height)) {
        return bad_input("glyphs.setting_size", "is {} x {} for a width of {}; allowed are 0 to {}",
                         setting.width, setting.height, setting.limit, max_side);
    }
    if (lines > max_lines || glyphs > max_glyphs ||
        lines * line_bytes + glyphs * glyph_bytes > reader.left()) {
        return bad_input("glyphs.setting_counts",
                         "claims {} lines and {} glyphs in {} bytes; allowed are {} and {}", lines, glyphs,
                         reader.left(), max_lines, max_glyphs);
    }
    setting.lines.resize(lines);
    std::uint64_t together = 0;
    for (GlyphLine& line : setting.lines) {
        line.baseline = reader.read<std::int32_t>();
        line.glyphs = reader.read<std::uint32_t>();
        together += line.glyphs;
        if (!is_place(line.baseline)) {
            return bad_input("glyphs.baseline", "has a line at {}; allowed are {} to {}", line.baseline,
                             -max_side, 2 * max_side);
        }
    }
    if (together != glyphs) {
        return bad_input("glyphs.lines", "has {} glyphs, and lines for {}", glyphs, together);
    }
    setting.glyphs.resize(glyphs);
    for (PlacedGlyph& glyph : setting.glyphs) {
        glyph.glyph = reader.read<std::uint16_t>();
        glyph.up = reader.read<std::int16_t>();
        glyph.x = reader.read<std::int32_t>();
        if (glyph.glyph >= boxes || !is_place(glyph.x)) {
            return bad_input("glyphs.place",
                             "has glyph {} at {}; there are {} glyphs, and allowed places are {} to {}",
                             glyph.glyph, glyph.x, boxes, -max_side, 2 * max_side);
        }
    }
    return setting;
}

Result<GlyphText> read_text(ByteReader& reader, std::size_t number, std::size_t boxes) {
    GlyphText text;
    const auto key_bytes = reader.read<std::uint8_t>();
    const auto direction = reader.read<std::uint8_t>();
    const auto settings = reader.read<std::uint16_t>();
    const std::vector<char> key = reader.read_all<char>(key_bytes);
    text.key.assign(key.begin(), key.end());
    if (!is_text_key(text.key)) {
        return bad_input("glyphs.key", "text {} has a bad key; allowed are 1 to {} of a-z 0-9 _ - and dots",
                         number, max_key_bytes);
    }
    if (direction > 1 || settings > max_settings) {
        return bad_input("glyphs.text", "text {} has direction {} and {} settings; allowed are 0 or 1 and {}",
                         text.key, direction, settings, max_settings);
    }
    text.direction = static_cast<TextDirection>(direction);
    for (std::size_t k = 0; k < settings; ++k) {
        Result<GlyphSetting> setting = read_setting(reader, boxes);
        if (!setting) {
            return bad_input("glyphs.setting", "setting {} of text {} {}", k, text.key,
                             setting.error().message);
        }
        text.settings.push_back(*std::move(setting));
    }
    return text;
}

} // namespace

const GlyphText* GlyphRuns::find(std::string_view key) const {
    const auto found =
        std::find_if(texts.begin(), texts.end(), [&](const GlyphText& text) { return text.key == key; });
    return found == texts.end() ? nullptr : &*found;
}

bool is_text_key(std::string_view key) {
    const auto allowed = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
    };
    return !key.empty() && key.size() <= max_key_bytes && std::all_of(key.begin(), key.end(), allowed);
}

Bytes encode_glyph_runs(const GlyphRuns& runs) {
    assert(runs.boxes.size() <= max_boxes && runs.texts.size() <= max_texts);
    Bytes bytes;
    for (const char c : magic) {
        append(bytes, c);
    }
    append(bytes, version);
    append(bytes, runs.texels_per_em);
    append(bytes, runs.spread_texels);
    append(bytes, runs.atlas_width);
    append(bytes, runs.atlas_height);
    append(bytes, static_cast<std::uint32_t>(runs.boxes.size()));
    append(bytes, static_cast<std::uint32_t>(runs.texts.size()));
    for (const GlyphBox& box : runs.boxes) {
        for (const std::uint16_t value : {box.x, box.y, box.width, box.height}) {
            append(bytes, value);
        }
        append(bytes, box.left);
        append(bytes, box.top);
    }
    for (const GlyphText& text : runs.texts) {
        assert(is_text_key(text.key) && text.settings.size() <= max_settings);
        append(bytes, static_cast<std::uint8_t>(text.key.size()));
        append(bytes, static_cast<std::uint8_t>(text.direction));
        append(bytes, static_cast<std::uint16_t>(text.settings.size()));
        append_all(bytes, std::vector<char>(text.key.begin(), text.key.end()));
        for (const GlyphSetting& setting : text.settings) {
            append_setting(bytes, setting);
        }
    }
    return bytes;
}

Result<GlyphRuns> decode_glyph_runs(std::span<const std::byte> bytes) {
    if (bytes.size() < header_bytes || std::memcmp(bytes.data(), magic.data(), magic.size()) != 0) {
        return bad_input("glyphs.no_magic", "it does not begin as glyph runs do (FSGR)");
    }
    ByteReader reader(bytes.subspan(magic.size()));
    if (const auto found = reader.read<std::uint32_t>(); found != version) {
        return bad_input("glyphs.version", "its glyph runs have version {}, allowed is {}", found, version);
    }
    std::size_t boxes = 0;
    std::size_t texts = 0;
    TRY(GlyphRuns runs, read_header(reader, boxes, texts));
    TRY_VOID(read_boxes(reader, boxes, runs));
    std::set<std::string> keys;
    for (std::size_t k = 0; k < texts; ++k) {
        TRY(GlyphText text, read_text(reader, k, boxes));
        if (!keys.insert(text.key).second) {
            return bad_input("glyphs.text_twice", "text {} occurs twice", text.key);
        }
        runs.texts.push_back(std::move(text));
    }
    if (!reader.ok() || reader.left() != 0) {
        return bad_input("glyphs.length", reader.ok() ? fmt::format("{} bytes are left over", reader.left())
                                                      : "it ends too early");
    }
    return runs;
}

Bytes encode_distance_atlas(const DistanceAtlas& atlas) {
    image::Image8 grey(atlas.width, atlas.height);
    std::transform(atlas.texels.begin(), atlas.texels.end(), grey.texels.begin(),
                   [](std::uint8_t code) { return glm::u8vec4(code, code, code, 255); });
    return image::encode_webp(grey);
}

Result<DistanceAtlas> decode_distance_atlas(std::span<const std::byte> bytes, const GlyphRuns& runs) {
    if (runs.atlas_width == 0 || runs.atlas_height == 0) {
        return bytes.empty() ? Result<DistanceAtlas>(DistanceAtlas())
                             : bad_input("glyphs.picture_unused",
                                         "there is a picture of glyphs, and the texts have none");
    }
    TRY(const image::Image8 grey, image::decode_webp8(bytes, max_atlas_texels));
    if (grey.width != runs.atlas_width || grey.height != runs.atlas_height) {
        return bad_input("glyphs.picture_size", "it has {} x {} texels; the texts need {} x {}", grey.width,
                         grey.height, runs.atlas_width, runs.atlas_height);
    }
    DistanceAtlas atlas(grey.width, grey.height);
    for (std::size_t k = 0; k < atlas.texels.size(); ++k) {
        const glm::u8vec4 texel = grey.texels[k];
        if (texel.r != texel.g || texel.g != texel.b || texel.a != 255) {
            return bad_input("glyphs.picture_not_grey", "it is not grey; distances are");
        }
        atlas.texels[k] = texel.r;
    }
    return atlas;
}

} // namespace frustumscreen::pack
