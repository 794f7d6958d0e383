#include "app/residency/caption_setter.h"

#include "app/pack/text_portions.h"

#include <algorithm>

namespace frustumscreen {

namespace {

/// Null if the bake could not set a part of the text: then all of it is set in the kiosk's typeface.
const SetLanguage* whole_in(std::span<const SetLanguage> set, const TableText& text) {
    const SetLanguage* const found = find_language(set, text.language);
    if (found == nullptr) {
        return nullptr;
    }
    const auto has = [&](const std::string& key, const std::string& part) {
        return part.empty() || found->runs.find(key) != nullptr;
    };
    return has(text.title_key, text.title) && has(text.text_key, text.text) ? found : nullptr;
}

} // namespace

TableText caption_text(const PackCaption& caption) {
    return {caption.language, "title", caption.title, "text", caption.text};
}

TableText portion_text(const PackCaption& caption, std::size_t portion, const std::string& text) {
    return {caption.language, {}, {}, portion_key(portion), text};
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
                ? make_caption(language->runs, language->atlas, language->runs.find(text.title_key),
                               language->runs.find(text.text_key), style_.em_m, width_m, style_.texels_per_m)
                : make_caption(*typesetter_, text.title, text.text, style_.em_m, width_m,
                               style_.texels_per_m));
    }
    return images;
}

Result<std::vector<glm::dvec2>> CaptionSetter::sizes_m(const TableText& text,
                                                       std::span<const SetLanguage> set) {
    const SetLanguage* const language = whole_in(set, text);
    TRY_VOID(language == nullptr ? open_typesetter() : Result<void>());
    std::vector<glm::dvec2> sizes;
    for (const double width_m : caption_widths_m) {
        sizes.push_back(language != nullptr
                            ? caption_size_m(language->runs, language->runs.find(text.title_key),
                                             language->runs.find(text.text_key), style_.em_m, width_m,
                                             style_.texels_per_m)
                            : caption_size_m(*typesetter_, text.title, text.text, style_.em_m, width_m,
                                             style_.texels_per_m));
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
