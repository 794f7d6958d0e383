#include "app/exhibit/exhibit.h"

#include <algorithm>
#include <utility>

namespace frustumscreen {

namespace {

std::string_view primary(std::string_view tag) {
    return tag.substr(0, tag.find('-'));
}

std::size_t place_of(std::string_view language, std::span<const std::string> languages) {
    return static_cast<std::size_t>(std::find(languages.begin(), languages.end(), language) -
                                    languages.begin());
}

} // namespace

Exhibit::Exhibit(std::size_t artifact_count, std::vector<std::string> languages, std::string language,
                 MonotonicTime now)
    : count_(artifact_count), languages_(std::move(languages)), language_count_(languages_.size()),
      language_before_(place_of(language, languages_)), artifact_(0, fade_time, now),
      language_(language_before_, fade_time, now) {
    if (language_before_ == languages_.size()) {
        languages_.push_back(std::move(language));
    }
}

void Exhibit::wish(Wish wish, MonotonicTime now) {
    if (!heeds(wish)) {
        return;
    }
    if (wish == Wish::NextLanguage) {
        language_before_ = language_.goal();
        change_language(language_before_ + 1 < language_count_ ? language_before_ + 1 : 0, now);
        return;
    }
    // With a language that is still to fade, after one that does already.
    const MonotonicTime begin =
        language_.begins() >= now ? language_.begins() : std::max(now, language_.ends());
    artifact_.change_to((artifact_.goal() + (wish == Wish::NextArtifact ? 1 : count_ - 1)) % count_, now,
                        begin);
}

/// With an artifact that is still to be dark, after one that fades in. Where they fade together, the caption
/// has one brightness by either.
void Exhibit::change_language(std::size_t which, MonotonicTime now) {
    if (which != language_.goal()) {
        language_.change_to(which, now,
                            now < artifact_.dark() ? artifact_.begins() : std::max(now, artifact_.ends()));
    }
}

void Exhibit::take_back(Wish wish, MonotonicTime now) {
    switch (wish) {
    case Wish::PreviousArtifact:
        this->wish(Wish::NextArtifact, now);
        break;
    case Wish::NextArtifact:
        this->wish(Wish::PreviousArtifact, now);
        break;
    case Wish::NextLanguage:
        change_language(language_before_, now);
        break;
    }
}

bool Exhibit::heeds(Wish wish) const {
    return (wish == Wish::NextLanguage ? language_count_ : count_) > 1;
}

Shown Exhibit::at(MonotonicTime now) const {
    if (count_ == 0) {
        return {};
    }
    const Faded artifact = artifact_.at(now);
    const Faded language = language_.at(now);
    return {artifact.which, artifact.brightness, languages_[language.which],
            std::min(artifact.brightness, language.brightness), artifact.changing || language.changing};
}

std::size_t caption_for(std::string_view language, std::span<const std::string> languages) {
    const auto find = [&](auto&& fits) {
        return static_cast<std::size_t>(std::find_if(languages.begin(), languages.end(), fits) -
                                        languages.begin());
    };
    std::size_t best = find([&](const std::string& tag) { return tag == language; });
    if (best == languages.size()) {
        best = find([&](const std::string& tag) { return primary(tag) == primary(language); });
    }
    if (best == languages.size()) {
        best = find([&](const std::string& tag) { return primary(tag) == "en"; });
    }
    return best == languages.size() ? 0 : best;
}

bool has_language(std::span<const std::string> languages, std::string_view language) {
    return std::any_of(languages.begin(), languages.end(),
                       [&](const std::string& tag) { return primary(tag) == primary(language); });
}

} // namespace frustumscreen
