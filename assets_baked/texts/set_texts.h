/// Sets the texts of one language: shaped for the widths of captions, with one atlas for all of them.
///
/// Errors   shape.h, glyph_atlas.h; messages begin with the text's key.
/// Threads  one caller.
#pragma once

#include "assets_baked/texts/glyph_atlas.h"
#include "assets_baked/texts/shape.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::texts {

/// The widths that captions are wrapped to, in type sizes. At 24 pt they are 30, 15 and 7.6 cm.
inline constexpr std::array<int, 3> caption_widths_em{36, 18, 9};

struct TextToSet {
    std::string key; ///< as `is_text_key` allows; unique
    std::string text;
    std::string language; ///< BCP 47
    bool bold = false;
};

struct SetTexts {
    GlyphSheet sheet;
    std::vector<std::string> notes; ///< losses, a sentence each, with the text's key
};

[[nodiscard]] Result<SetTexts> set_texts(std::span<const TextToSet> texts, const Shaper& shaper,
                                         const GlyphAtlasOptions& options = {});

} // namespace frustumscreen::texts
