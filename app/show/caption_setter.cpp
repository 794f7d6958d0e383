#include "app/show/caption_setter.h"

#include <algorithm>

namespace frustumscreen {

namespace {

const SetLanguage* find(std::span<const SetLanguage> set, const std::string& language) {
    const auto found = std::find_if(set.begin(), set.end(),
                                    [&](const SetLanguage& each) { return each.language == language; });
    return found != set.end() ? &*found : nullptr;
}

/// Null if a text of the caption could not be set at the bake: then all of it is in one typeface, the kiosk's.
const SetLanguage* whole_in(std::span<const SetLanguage> set, const PackCaption& caption) {
    const SetLanguage* const found = find(set, caption.language);
    if (found == nullptr) {
        return nullptr;
    }
    const auto has = [&](std::string_view key, const std::string& text) {
        return text.empty() || found->runs.find(key) != nullptr;
    };
    return has("title", caption.title) && has("text", caption.text) ? found : nullptr;
}

} // namespace

Result<std::vector<CaptionImage>> CaptionSetter::set(const PackCaption& caption,
                                                     std::span<const SetLanguage> set) {
    const SetLanguage* const language = whole_in(set, caption);
    if (Result<void> opened = language == nullptr ? open_typesetter() : Result<void>(); !opened) {
        return tl::unexpected<Error>(opened.error());
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

Result<SetPortion> CaptionSetter::set_portion(const std::string& language, const std::string& key,
                                              const std::string& text, std::span<const SetLanguage> set) {
    const SetLanguage* const there = find(set, language);
    const GlyphText* const glyphs = there != nullptr ? there->runs.find(key) : nullptr;
    if (Result<void> opened = glyphs == nullptr ? open_typesetter() : Result<void>(); !opened) {
        return tl::unexpected<Error>(opened.error());
    }
    SetPortion portion;
    portion.flush_right = glyphs != nullptr && glyphs->direction == TextDirection::RightToLeft;
    for (const double width_m : caption_widths_m) {
        portion.images.push_back(
            glyphs != nullptr
                ? make_caption(there->runs, there->atlas, nullptr, glyphs, em_m_, width_m, texels_per_m_)
                : make_caption(*typesetter_, {}, text, em_m_, width_m, texels_per_m_));
    }
    return portion;
}

Result<void> CaptionSetter::open_typesetter() {
    if (!typesetter_) {
        Result<Typesetter> opened = Typesetter::open();
        if (!opened) {
            return tl::unexpected<Error>(opened.error());
        }
        typesetter_ = std::move(*opened);
    }
    return {};
}

} // namespace frustumscreen
