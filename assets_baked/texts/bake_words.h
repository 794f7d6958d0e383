/// Bakes the exhibit's own words: collects (words.h) and sets them. speak_words.h adds the sounds.
///
/// Errors   set_texts.h; messages begin with the language.
/// Threads  one caller.
#pragma once

#include "app/pack/words_file.h"
#include "assets_baked/texts/set_texts.h"
#include "assets_baked/texts/words.h"

#include <string>
#include <vector>

namespace frustumscreen::texts {

struct BakedWords {
    std::vector<pack::LanguageWords> languages;
    std::vector<std::string> notes; ///< losses, a sentence each
};

[[nodiscard]] Result<BakedWords> bake_words(const std::vector<CollectedWords>& collected,
                                            const Shaper& shaper);

} // namespace frustumscreen::texts
