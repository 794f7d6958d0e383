#include "app/exhibit/sentences.h"

#include "app/exhibit/languages.h"
#include "app/geometry/time_curves.h"

#include <algorithm>

namespace frustumscreen::exhibit {

Sentences::Sentences(std::vector<AdviceLanguage> words, std::span<const glm::dvec2> picture_m)
    : words_(std::move(words)), placer_(picture_m) {
    for (const AdviceLanguage& each : words_) {
        languages_.push_back(each.language);
    }
}

std::optional<WordIndex> Sentences::find(std::string_view key, std::string_view language) const {
    if (words_.empty()) {
        return std::nullopt;
    }
    const std::size_t nearest = caption_for(language, languages_);
    const std::vector<AdviceText>& texts = words_[nearest].texts;
    const auto found =
        std::find_if(texts.begin(), texts.end(), [&](const AdviceText& text) { return text.key == key; });
    return found != texts.end()
               ? std::optional(WordIndex{nearest, static_cast<std::size_t>(found - texts.begin())})
               : std::nullopt;
}

bool Sentences::shows(MonotonicTime now, const WordIndex& word) const {
    const typography::CaptionPlace place = placer_.at(now);
    const bool has_space = place.rectangle.size_m.x > 0.0;
    return placed_ == word && has_space && (place.opacity > 0.0 || now - appears_ < leaves);
}

std::optional<PresentedAdvice> Sentences::place(MonotonicTime now, const std::optional<WordIndex>& wanted,
                                                const SentenceEnvironment& environment) {
    const double step = to_seconds(now - last_) / to_seconds(leaves);
    last_ = now;
    const bool stays = placed_ == wanted;
    share_ = std::clamp(share_ + (stays ? step : -step), 0.0, 1.0);
    if (!stays && (share_ <= 0.0 || placer_.at(now).opacity <= 0.0)) {
        placed_ = wanted;
        share_ = 1.0; // the placer fades it in
        appears_ = now;
        placer_.set_shapes(
            wanted ? std::span<const glm::dvec2>(words_[wanted->language].texts[wanted->text].sizes_m)
                   : std::span<const glm::dvec2>());
    }
    if (!placed_) {
        return std::nullopt;
    }
    placer_.update(now, environment.around, environment.hidden, environment.prop_m,
                   environment.quarter_turns);
    const typography::CaptionPlace place = placer_.at(now);
    const double brightness = place.opacity * geometry::ease(share_);
    return brightness > 0.0 ? std::optional(PresentedAdvice{.word = *placed_,
                                                            .shape = place.shape,
                                                            .rectangle = place.rectangle,
                                                            .brightness = brightness})
                            : std::nullopt;
}

} // namespace frustumscreen::exhibit
