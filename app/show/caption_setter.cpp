#include "app/show/caption_setter.h"

#include <algorithm>

namespace frustumscreen {

namespace {

/// Null if a text of the caption could not be set at the bake: then all of it is in one typeface, the kiosk's.
const SetLanguage* whole_in(std::span<const SetLanguage> set, const PackCaption& caption) {
    const auto found = std::find_if(set.begin(), set.end(), [&](const SetLanguage& language) {
        return language.language == caption.language;
    });
    if (found == set.end()) {
        return nullptr;
    }
    const auto has = [&](std::string_view key, const std::string& text) {
        return text.empty() || found->runs.find(key) != nullptr;
    };
    return has("title", caption.title) && has("text", caption.text) ? &*found : nullptr;
}

} // namespace

Result<std::vector<CaptionImage>> CaptionSetter::set(const PackCaption& caption,
                                                     std::span<const SetLanguage> set) {
    const SetLanguage* const language = whole_in(set, caption);
    if (language == nullptr && !typesetter_) {
        Result<Typesetter> opened = Typesetter::open();
        if (!opened) {
            return tl::unexpected<Error>(opened.error());
        }
        typesetter_ = std::move(*opened);
    }
    std::vector<CaptionImage> images;
    for (const double width_m : caption_widths_m) {
        images.push_back(
            language != nullptr
                ? make_caption(language->runs, language->atlas, language->runs.find("title"),
                               language->runs.find("text"), em_m_, width_m, texels_per_m_)
                : make_caption(*typesetter_, caption.title, caption.text, em_m_, width_m, texels_per_m_));
    }
    return images;
}

} // namespace frustumscreen
