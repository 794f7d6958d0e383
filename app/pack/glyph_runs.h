/// Texts shaped at the bake: lines of numbered glyphs, and each glyph's place in a picture of distances. A kiosk
/// sets them at any size without a shaper and without a typeface (app/typography/glyph_image.h).
///
/// Frame    a setting: x to the right from the left edge of its box, y down from its top edge. A box: texels of the
///          atlas, row 0 at the top.
/// Units    1/1024 of the type size (`em_units`), or texels if the name says so.
/// Errors   `decode_...` takes outside bytes: one line, without the part's name (the caller knows it). Limits are
///          checked before memory is allocated.
/// Threads  values and pure functions; any.
/// Source   FORMAT.md defines the bytes; the picture of distances: Green, Improved Alpha-Tested Magnification for
///          Vector Textures and Special Effects, SIGGRAPH 2007.
#pragma once

#include "app/image/image.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::pack {

inline constexpr std::int32_t em_units = 1024;

/// A glyph's rectangle in the atlas. A box without texels, such as that of a space, draws nothing.
struct GlyphBox {
    std::uint16_t x = 0, y = 0, width = 0, height = 0;
    std::int16_t left = 0; ///< texels from the pen to the rectangle's left edge
    std::int16_t top = 0;  ///< texels from the baseline up to its top edge
    bool operator==(const GlyphBox&) const = default;
};

struct PlacedGlyph {
    std::uint16_t glyph = 0; ///< index into the boxes
    std::int16_t up = 0;     ///< of the pen above the baseline
    std::int32_t x = 0;      ///< of the pen
    bool operator==(const PlacedGlyph&) const = default;
};

struct GlyphLine {
    std::int32_t baseline = 0;
    std::uint32_t glyphs = 0; ///< number of the setting's glyphs in this line; the lines share them in order
    bool operator==(const GlyphLine&) const = default;
};

/// A text broken into lines for one width.
struct GlyphSetting {
    std::int32_t limit = 0;  ///< the width for which the lines were broken
    std::int32_t width = 0;  ///< of its box: the widest line's
    std::int32_t height = 0; ///< of its box
    std::vector<GlyphLine> lines;
    std::vector<PlacedGlyph> glyphs;
    bool operator==(const GlyphSetting&) const = default;
};

enum class TextDirection : std::uint8_t { LeftToRight, RightToLeft };

struct GlyphText {
    std::string key;
    TextDirection direction = TextDirection::LeftToRight; ///< of the paragraph
    std::vector<GlyphSetting> settings;                   ///< one for each width
    bool operator==(const GlyphText&) const = default;
};

/// The texts of one language, and the glyphs that they share.
struct GlyphRuns {
    std::uint16_t texels_per_em = 0;
    std::uint16_t spread_texels = 0; ///< larger distances are clipped
    std::uint16_t atlas_width = 0, atlas_height = 0;
    std::vector<GlyphBox> boxes;
    std::vector<GlyphText> texts;
    bool operator==(const GlyphRuns&) const = default;

    /// Null if there is no text of this key.
    [[nodiscard]] const GlyphText* find(std::string_view key) const;
};

/// Signed distances to the outline: code 128 is the outline, higher codes are inside; 128 codes are
/// `spread_texels`.
using DistanceAtlas = image::Image<std::uint8_t>;
inline constexpr int outline_code = 128;

namespace glyph_limits {
inline constexpr int max_texels_per_em = 256;
inline constexpr int max_spread_texels = 64;
inline constexpr int max_atlas_side = 8192;
inline constexpr std::int64_t max_atlas_texels = 1 << 24;
inline constexpr std::size_t max_boxes = 65535; ///< their numbers are 16 bits
inline constexpr std::size_t max_texts = 1024;
inline constexpr std::size_t max_key_bytes = 100;
inline constexpr std::size_t max_settings = 8;
inline constexpr std::size_t max_lines = 1000;           ///< of one setting
inline constexpr std::size_t max_glyphs = 20000;         ///< of one setting
inline constexpr std::int32_t max_side = 256 * em_units; ///< of a setting's box, and of a coordinate in it
} // namespace glyph_limits

/// True if a text may have this key: a-z 0-9 _ - and dots.
[[nodiscard]] bool is_text_key(std::string_view key);

/// `runs` must keep the limits.
[[nodiscard]] Bytes encode_glyph_runs(const GlyphRuns& runs);
[[nodiscard]] Result<GlyphRuns> decode_glyph_runs(std::span<const std::byte> bytes);

/// Lossless WebP, grey. Empty if the picture is empty.
[[nodiscard]] Bytes encode_distance_atlas(const DistanceAtlas& atlas);
/// The picture of `runs`: it must be grey and have the size that `runs` names.
[[nodiscard]] Result<DistanceAtlas> decode_distance_atlas(std::span<const std::byte> bytes,
                                                          const GlyphRuns& runs);

} // namespace frustumscreen::pack
