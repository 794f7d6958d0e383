/// The safe picture's words, which the build compiles into the program: shaped lines of numbered glyphs, a
/// letter for each character of a reason, and one picture of distances. frustumscreen-safe-words
/// (assets_baked/safe) writes them as C++, so nothing is read or parsed at run time.
///
/// Frame    a setting: x to the right from the left edge of its box, y down from its top.
/// Units    1/1024 of the type size (`baked_em_units`), or texels of the atlas where the name says so.
/// Threads  constants; any.
/// Source   as app/pack/glyph_runs.h, from which the distances come.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace frustumscreen::safe {

inline constexpr std::int32_t baked_em_units = 1024;
inline constexpr int baked_outline_code = 128; ///< distance code of the outline; larger inside

/// A glyph's rectangle in the atlas; an empty one draws nothing.
struct BakedBox {
    std::uint16_t x = 0, y = 0, width = 0, height = 0;
    std::int16_t left = 0; ///< texels from the pen to the rectangle's left edge
    std::int16_t top = 0;  ///< texels from the baseline up to its top edge
};

struct BakedGlyph {
    std::uint16_t box = 0; ///< index
    std::int32_t x = 0;    ///< of the pen
    std::int32_t y = 0;    ///< of the pen, down from the top of the setting
};

/// A text broken into lines for one width; each line is centred.
struct BakedSetting {
    std::int32_t width = 0, height = 0; ///< of its box
    std::int32_t baseline = 0;          ///< of its first line, down from the top
    std::span<const BakedGlyph> glyphs;
};

struct BakedLanguage {
    std::string_view language;               ///< BCP 47
    BakedSetting visitors;                   ///< in one line
    std::span<const BakedSetting> for_staff; ///< the widest first
};

/// The letters of a reason.
struct BakedLetter {
    char32_t character = 0;
    std::uint16_t box = 0;
    std::int32_t advance = 0;
};

struct SafeWords {
    int texels_per_em = 0;
    int spread_texels = 0; ///< 128 codes
    int atlas_width = 0;
    std::int32_t ascent = 0;              ///< of a line of letters, from its top to its baseline
    std::int32_t pitch = 0;               ///< from line to line
    std::span<const unsigned char> atlas; ///< row by row from the top
    std::span<const BakedBox> boxes;
    std::span<const BakedLanguage> languages;
    std::span<const BakedLetter> letters; ///< in order of their characters
};

[[nodiscard]] const SafeWords& safe_words();

} // namespace frustumscreen::safe
