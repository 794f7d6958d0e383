/// Bakes the exhibit's own words: collected (words.h) and set. speak_words.h gives them sounds.
///
/// Errors   set_texts.h; the language comes first.
/// Threads  one caller.
#pragma once

#include "app/pack/words_file.h"
#include "assets_baked/texts/set_texts.h"
#include "assets_baked/texts/words.h"

#include <string>
#include <vector>

namespace frustumscreen {

struct BakedWords {
    std::vector<LanguageWords> languages;
    std::vector<std::string> notes; ///< what is lost, a sentence each
};

[[nodiscard]] Result<BakedWords> bake_words(const std::vector<CollectedWords>& collected,
                                            const Shaper& shaper);

} // namespace frustumscreen
