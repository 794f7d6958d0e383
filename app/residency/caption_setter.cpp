#include "app/residency/caption_setter.h"

#include "app/pack/text_portions.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::residency {

namespace {

/// Null if the bake could not set a part of the text: then the whole text is set in the kiosk's typeface.
const pack::SetLanguage* whole_in(std::span<const pack::SetLanguage> set, const TableText& text) {
    const pack::SetLanguage* const found = find_language(set, text.language);
    if (found == nullptr) {
        return nullptr;
    }
    const bool is_whole = std::all_of(text.pieces.begin(), text.pieces.end(), [&](const TextPiece& piece) {
        return piece.text.empty() || found->runs.find(piece.key) != nullptr;
    });
    return is_whole ? found : nullptr;
}

std::vector<typography::GlyphPart> glyph_parts(const TableText& text, const pack::GlyphRuns& runs) {
    std::vector<typography::GlyphPart> parts;
    for (const TextPiece& piece : text.pieces) {
        parts.push_back({piece.role, runs.find(piece.key)});
    }
    return parts;
}

std::vector<typography::PlainPart> plain_parts(const TableText& text) {
    std::vector<typography::PlainPart> parts;
    for (const TextPiece& piece : text.pieces) {
        parts.push_back({piece.role, piece.text});
    }
    return parts;
}

} // namespace

TableText caption_text(const pack::PackCaption& caption) {
    return {caption.language,
            {{typography::CaptionRole::Title, "title", caption.title},
             {typography::CaptionRole::Text, "text", caption.text}}};
}

TableText portion_text(const pack::PackCaption& caption, std::size_t portion, const std::string& text) {
    return {caption.language, {{typography::CaptionRole::Text, pack::portion_key(portion), text}}};
}

std::vector<TextPiece> attribution_pieces(const pack::PackCaption& caption, const pack::ScanRights& rights,
                                          std::span<const pack::SetLanguage> set,
                                          typography::CaptionRole role) {
    std::vector<TextPiece> pieces;
    const std::string whole = pack::attribution_of(caption, rights);
    if (whole.empty()) {
        return pieces;
    }
    const pack::SetLanguage* const language = find_language(set, caption.language);
    if (language == nullptr || language->runs.find(pack::attribution_key) != nullptr) {
        return {{role, std::string(pack::attribution_key), whole}};
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

const pack::SetLanguage* find_language(std::span<const pack::SetLanguage> set, const std::string& language) {
    const auto found = std::find_if(set.begin(), set.end(),
                                    [&](const pack::SetLanguage& each) { return each.language == language; });
    return found != set.end() ? &*found : nullptr;
}

Result<std::vector<typography::CaptionImage>> CaptionSetter::set(const TableText& text,
                                                                 std::span<const pack::SetLanguage> set) {
    const pack::SetLanguage* const language = whole_in(set, text);
    TRY_VOID(language == nullptr ? open_typesetter() : Result<void>());
    std::vector<typography::CaptionImage> images;
    for (const double width_m : typography::caption_widths_m) {
        images.push_back(language != nullptr
                             ? typography::make_caption(language->runs, language->atlas,
                                                        glyph_parts(text, language->runs), style_.em_m,
                                                        width_m, style_.texels_per_m)
                             : typography::make_caption(*typesetter_, plain_parts(text), style_.em_m, width_m,
                                                        style_.texels_per_m));
    }
    return images;
}

Result<std::vector<glm::dvec2>> CaptionSetter::sizes_m(const TableText& text,
                                                       std::span<const pack::SetLanguage> set) {
    const pack::SetLanguage* const language = whole_in(set, text);
    TRY_VOID(language == nullptr ? open_typesetter() : Result<void>());
    std::vector<glm::dvec2> sizes;
    for (const double width_m : typography::caption_widths_m) {
        sizes.push_back(language != nullptr
                            ? typography::caption_size_m(language->runs, glyph_parts(text, language->runs),
                                                         style_.em_m, width_m, style_.texels_per_m)
                            : typography::caption_size_m(*typesetter_, plain_parts(text), style_.em_m,
                                                         width_m, style_.texels_per_m));
    }
    return sizes;
}

Result<void> CaptionSetter::open_typesetter() {
    if (!typesetter_) {
        TRY(typesetter_, typography::Typesetter::open());
    }
    return {};
}

} // namespace frustumscreen::residency
