/// Bakes the exhibit's own words: collected, shaped, and spoken where there is a voice.
///
/// Errors   words.h, shape.h.
/// Threads  one caller.
#pragma once

#include "app/pack/words_file.h"
#include "assets_baked/texts/glyph_atlas.h"
#include "assets_baked/texts/shape.h"
#include "assets_baked/texts/words.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace frustumscreen {

/// The widths that captions are broken for, in type sizes. At 24 pt they are 30, 15 and 7.6 cm.
inline constexpr std::array<int, 3> caption_widths_em{36, 18, 9};

struct BakedWords {
    std::vector<LanguageWords> languages;
    std::vector<std::string> notes; ///< what is lost, a sentence each
};

[[nodiscard]] Result<BakedWords> bake_words(const std::vector<CollectedWords>& collected,
                                            const Shaper& shaper, const GlyphAtlasOptions& options = {});

} // namespace frustumscreen
