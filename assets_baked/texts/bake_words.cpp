#include "assets_baked/texts/bake_words.h"

#include <fmt/format.h>

namespace frustumscreen::texts {

Result<BakedWords> bake_words(const std::vector<CollectedWords>& collected, const Shaper& shaper) {
    BakedWords baked;
    for (const CollectedWords& language : collected) {
        baked.notes.insert(baked.notes.end(), language.notes.begin(), language.notes.end());
        pack::LanguageWords words;
        words.language = language.language;
        std::vector<TextToSet> texts;
        for (const Word& word : language.words) {
            if (word.key == "name") {
                words.name = word.text;
            }
            texts.push_back({.key = word.key, .text = word.text, .language = word.language, .bold = false});
            words.words.push_back({word.key, word.text, word.language});
        }
        TRY(SetTexts set, at(language.language, set_texts(texts, shaper)));
        for (const std::string& note : set.notes) {
            baked.notes.push_back(fmt::format("{}: {}", language.language, note));
        }
        words.runs = std::move(set.sheet.runs);
        words.atlas = std::move(set.sheet.atlas);
        baked.languages.push_back(std::move(words));
    }
    return baked;
}

} // namespace frustumscreen::texts
