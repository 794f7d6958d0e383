// A words file with a single one-letter word in each of two languages, for the target and its seeds.
#pragma once

#include "app/pack/words_file.h"

namespace frustumscreen::fuzz {

inline pack::LanguageWords words_in(const std::string& language, const std::string& name) {
    pack::LanguageWords words{language, name, {{"help", "Text", language}}, {}, {}, {}};
    words.runs = {
        8,
        2,
        6,
        5,
        {{0, 0, 6, 5, -1, 4}},
        {{"help", pack::TextDirection::LeftToRight, {{9216, 1024, 1400, {{1100, 1}}, {{0, 0, 12}}}}}}};
    words.atlas = pack::DistanceAtlas(6, 5, 7);
    words.sounds.emplace("help", Bytes(10, std::byte{7}));
    return words;
}

inline Bytes small_words_file() {
    return pack::write_words(
               std::vector<pack::LanguageWords>{words_in("de", "Deutsch"), words_in("fr", "Fran\u00e7ais")})
        .value_or(Bytes());
}

} // namespace frustumscreen::fuzz
