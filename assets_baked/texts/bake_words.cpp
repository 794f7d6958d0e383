#include "assets_baked/texts/bake_words.h"

#include <fmt/format.h>

namespace frustumscreen {

namespace {

std::vector<std::int32_t> caption_limits() {
    std::vector<std::int32_t> limits;
    for (const int width : caption_widths_em) {
        limits.push_back(width * em_units);
    }
    return limits;
}

Result<LanguageWords> bake_language(const CollectedWords& collected, const Shaper& shaper,
                                    const GlyphAtlasOptions& options, std::vector<std::string>& notes) {
    LanguageWords words;
    words.language = collected.language;
    GlyphAtlasBuilder builder(options);
    for (const Word& word : collected.words) {
        if (word.key == "name") {
            words.name = word.text;
        }
        const Result<ShapedText> shaped = shaper.shape({word.text, word.language, caption_limits(), false});
        if (!shaped) {
            return at(word.key, shaped.error());
        }
        for (const std::string& note : shaped->notes) {
            notes.push_back(fmt::format("{}: {}: {}", collected.language, word.key, note));
        }
        builder.add(word.key, *shaped);
        words.words.push_back({word.key, word.text, word.language});
    }
    Result<GlyphSheet> sheet = builder.finish();
    if (!sheet) {
        return at(collected.language, sheet.error());
    }
    words.runs = std::move(sheet->runs);
    words.atlas = std::move(sheet->atlas);
    return words;
}

} // namespace

Result<BakedWords> bake_words(const std::vector<CollectedWords>& collected, const Shaper& shaper,
                              const GlyphAtlasOptions& options) {
    BakedWords baked;
    for (const CollectedWords& language : collected) {
        baked.notes.insert(baked.notes.end(), language.notes.begin(), language.notes.end());
        Result<LanguageWords> words = bake_language(language, shaper, options, baked.notes);
        if (!words) {
            return tl::unexpected<Error>(words.error());
        }
        baked.languages.push_back(*std::move(words));
    }
    return baked;
}

} // namespace frustumscreen
