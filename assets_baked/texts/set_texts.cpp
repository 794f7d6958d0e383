#include "assets_baked/texts/set_texts.h"

#include <fmt/format.h>

namespace frustumscreen::texts {

namespace {

std::vector<std::int32_t> caption_limits() {
    std::vector<std::int32_t> limits;
    for (const int width : caption_widths_em) {
        limits.push_back(width * pack::em_units);
    }
    return limits;
}

} // namespace

Result<SetTexts> set_texts(std::span<const TextToSet> texts, const Shaper& shaper,
                           const GlyphAtlasOptions& options) {
    SetTexts set;
    GlyphAtlasBuilder builder(options);
    for (const TextToSet& text : texts) {
        TRY(const ShapedText shaped, at(text.key, shaper.shape({.text = text.text,
                                                                .language = text.language,
                                                                .limits = caption_limits(),
                                                                .bold = text.bold})));
        for (const std::string& note : shaped.notes) {
            set.notes.push_back(fmt::format("{}: {}", text.key, note));
        }
        builder.add(text.key, shaped);
    }
    TRY(set.sheet, builder.finish());
    return set;
}

} // namespace frustumscreen::texts
