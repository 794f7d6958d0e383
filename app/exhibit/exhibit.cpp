#include "app/exhibit/exhibit.h"

#include <algorithm>
#include <utility>

namespace frustumscreen {

namespace {

std::string_view primary(std::string_view tag) {
    return tag.substr(0, tag.find('-'));
}

} // namespace

Exhibit::Exhibit(std::size_t artifact_count, std::vector<std::string> languages, std::string language,
                 MonotonicTime now)
    : count_(artifact_count), languages_(std::move(languages)), language_(std::move(language)),
      language_before_(language_), fade_(0, fade_time, now) {}

void Exhibit::wish(Wish wish, MonotonicTime now) {
    if (wish == Wish::NextLanguage) {
        language_before_ = language_;
        if (!languages_.empty()) {
            const auto current = std::find(languages_.begin(), languages_.end(), language_);
            const bool last = current == languages_.end() || current + 1 == languages_.end();
            language_ = last ? languages_.front() : *(current + 1);
        }
        return;
    }
    if (count_ > 1) {
        fade_.change_to((fade_.goal() + (wish == Wish::NextArtifact ? 1 : count_ - 1)) % count_, now);
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
        language_ = language_before_;
        break;
    }
}

bool Exhibit::heeds(Wish wish) const {
    return (wish == Wish::NextLanguage ? languages_.size() : count_) > 1;
}

Shown Exhibit::at(MonotonicTime now) const {
    if (count_ == 0) {
        return {};
    }
    const Faded faded = fade_.at(now);
    return {faded.which, faded.brightness, faded.changing};
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
