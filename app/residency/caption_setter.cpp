#include "app/residency/caption_setter.h"

#include "app/pack/text_portions.h"

#include <algorithm>
#include <utility>

namespace frustumscreen {

namespace {

/// Null if the bake could not set a part of the text: then the whole text is set in the kiosk's typeface.
const SetLanguage* whole_in(std::span<const SetLanguage> set, const TableText& text) {
    const SetLanguage* const found = find_language(set, text.language);
    if (found == nullptr) {
        return nullptr;
    }
    const bool is_whole = std::all_of(text.pieces.begin(), text.pieces.end(), [&](const TextPiece& piece) {
        return piece.text.empty() || found->runs.find(piece.key) != nullptr;
    });
    return is_whole ? found : nullptr;
}

std::vector<GlyphPart> glyph_parts(const TableText& text, const GlyphRuns& runs) {
    std::vector<GlyphPart> parts;
    for (const TextPiece& piece : text.pieces) {
        parts.push_back({piece.role, runs.find(piece.key)});
    }
    return parts;
}

std::vector<PlainPart> plain_parts(const TableText& text) {
    std::vector<PlainPart> parts;
    for (const TextPiece& piece : text.pieces) {
        parts.push_back({piece.role, piece.text});
    }
    return parts;
}

} // namespace

TableText caption_text(const PackCaption& caption) {
    return {caption.language,
            {{CaptionRole::Title, "title", caption.title}, {CaptionRole::Text, "text", caption.text}}};
}

TableText portion_text(const PackCaption& caption, std::size_t portion, const std::string& text) {
    return {caption.language, {{CaptionRole::Text, portion_key(portion), text}}};
}

std::vector<TextPiece> attribution_pieces(const PackCaption& caption, const ScanRights& rights,
                                          std::span<const SetLanguage> set, CaptionRole role) {
    std::vector<TextPiece> pieces;
    const std::string whole = attribution_of(caption, rights);
    if (whole.empty()) {
        return pieces;
    }
    const SetLanguage* const language = find_language(set, caption.language);
    if (language == nullptr || language->runs.find(attribution_key) != nullptr) {
        return {{role, std::string(attribution_key), whole}};
    }
    for (const auto& [key, text] : {std::pair("maker", &caption.maker),
                                    {"place", &caption.place},
                                    {"period", &caption.period},
                                    {"credit", &caption.credit}}) {
        if (!text->empty() && language->runs.find(key) != nullptr) {
            pieces.push_back({role, key, *text});
        }
    }
    return pieces;
}

const SetLanguage* find_language(std::span<const SetLanguage> set, const std::string& language) {
    const auto found = std::find_if(set.begin(), set.end(),
                                    [&](const SetLanguage& each) { return each.language == language; });
    return found != set.end() ? &*found : nullptr;
}

Result<std::vector<CaptionImage>> CaptionSetter::set(const TableText& text,
                                                     std::span<const SetLanguage> set) {
    const SetLanguage* const language = whole_in(set, text);
    TRY_VOID(language == nullptr ? open_typesetter() : Result<void>());
    std::vector<CaptionImage> images;
    for (const double width_m : caption_widths_m) {
        images.push_back(
            language != nullptr
                ? make_caption(language->runs, language->atlas, glyph_parts(text, language->runs),
                               style_.em_m, width_m, style_.texels_per_m)
                : make_caption(*typesetter_, plain_parts(text), style_.em_m, width_m, style_.texels_per_m));
    }
    return images;
}

Result<std::vector<glm::dvec2>> CaptionSetter::sizes_m(const TableText& text,
                                                       std::span<const SetLanguage> set) {
    const SetLanguage* const language = whole_in(set, text);
    TRY_VOID(language == nullptr ? open_typesetter() : Result<void>());
    std::vector<glm::dvec2> sizes;
    for (const double width_m : caption_widths_m) {
        sizes.push_back(
            language != nullptr
                ? caption_size_m(language->runs, glyph_parts(text, language->runs), style_.em_m, width_m,
                                 style_.texels_per_m)
                : caption_size_m(*typesetter_, plain_parts(text), style_.em_m, width_m, style_.texels_per_m));
    }
    return sizes;
}

Result<void> CaptionSetter::open_typesetter() {
    if (!typesetter_) {
        TRY(typesetter_, Typesetter::open());
    }
    return {};
}

} // namespace frustumscreen
