#include "app/exhibit/selection.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::exhibit {

namespace {

std::size_t place_of(std::string_view language, std::span<const std::string> languages) {
    return static_cast<std::size_t>(std::find(languages.begin(), languages.end(), language) -
                                    languages.begin());
}

} // namespace

Selection::Selection(std::size_t artifact_count, std::vector<std::string> languages, std::string language,
                     MonotonicTime now)
    : count_(artifact_count), left_out_(artifact_count), languages_(std::move(languages)),
      language_count_(languages_.size()), first_language_(place_of(language, languages_)),
      language_before_(first_language_), turned_(now), artifact_(0, fade_time, now),
      language_(first_language_, fade_time, now) {
    if (first_language_ == languages_.size()) {
        languages_.push_back(std::move(language));
    }
}

void Selection::begin_with(std::size_t artifact, std::string_view language, MonotonicTime now) {
    if (artifact < count_) {
        artifact_ = Fade(artifact, fade_time, now);
    }
    if (const std::size_t place = place_of(language, languages_); place < language_count_) {
        language_ = Fade(place, fade_time, now);
        language_before_ = place;
    }
}

void Selection::take(settings::Command command, MonotonicTime now) {
    if (!accepts(command)) {
        return;
    }
    if (command == settings::Command::NextLanguage) {
        language_before_ = language_.goal();
        change_language(language_before_ + 1 < language_count_ ? language_before_ + 1 : 0, now);
        return;
    }
    choose(command == settings::Command::NextArtifact ? next() : previous(), now);
}

/// Begins together with a language change that has not begun yet, and after one that has.
void Selection::choose(std::size_t artifact, MonotonicTime now) {
    if (artifact < count_ && !left_out_[artifact] && artifact != artifact_.goal()) {
        const MonotonicTime begin =
            language_.begins() >= now ? language_.begins() : std::max(now, language_.ends());
        artifact_.change_to(artifact, now, begin);
    }
}

void Selection::offer(std::size_t artifact, bool offered, MonotonicTime now) {
    left_out_[artifact] = !offered;
    if (left_out_[artifact_.goal()]) {
        choose(next(), now);
    }
}

std::size_t Selection::neighbour(std::size_t step) const {
    std::size_t artifact = artifact_.goal();
    for (std::size_t k = 0; k < count_; ++k) {
        artifact = (artifact + step) % count_;
        if (!left_out_[artifact]) {
            return artifact;
        }
    }
    return artifact_.goal();
}

/// Begins together with an artifact's change that is not dark yet, and after one that fades in. If both fade
/// together, they give the caption the same brightness.
void Selection::change_language(std::size_t which, MonotonicTime now) {
    if (which != language_.goal()) {
        language_.change_to(which, now,
                            now < artifact_.dark() ? artifact_.begins() : std::max(now, artifact_.ends()));
    }
}

void Selection::turn(MonotonicTime now) {
    choose(next(), now);
    turned_ = now;
}

void Selection::rest(MonotonicTime now) {
    turned_ = now;
    language_before_ = first_language_;
    change_language(first_language_, now);
}

void Selection::undo(settings::Command command, MonotonicTime now) {
    switch (command) {
    case settings::Command::PreviousArtifact:
        take(settings::Command::NextArtifact, now);
        break;
    case settings::Command::NextArtifact:
        take(settings::Command::PreviousArtifact, now);
        break;
    case settings::Command::NextLanguage:
        change_language(language_before_, now);
        break;
    case settings::Command::Choose:
    case settings::Command::Help:
    case settings::Command::Behaviour:
    case settings::Command::Window:
    case settings::Command::StaffMode:
    case settings::Command::HoldFirst:
    case settings::Command::HoldOther:
    case settings::Command::HoldWindow:
        break;
    }
}

bool Selection::accepts(settings::Command command) const {
    switch (command) {
    case settings::Command::PreviousArtifact:
    case settings::Command::NextArtifact:
        return count_ > 1 && next() != artifact_.goal();
    case settings::Command::NextLanguage:
        return language_count_ > 1;
    case settings::Command::Choose:
    case settings::Command::Help:
    case settings::Command::Behaviour:
    case settings::Command::Window:
    case settings::Command::StaffMode:
    case settings::Command::HoldFirst:
    case settings::Command::HoldOther:
    case settings::Command::HoldWindow:
        break;
    }
    return false;
}

Shown Selection::at(MonotonicTime now) const {
    if (count_ == 0) {
        return {};
    }
    const Faded artifact = artifact_.at(now);
    const Faded language = language_.at(now);
    return {.artifact = artifact.which,
            .brightness = artifact.brightness,
            .language = languages_[language.which],
            .caption_brightness = std::min(artifact.brightness, language.brightness),
            .changing = artifact.changing || language.changing,
            .leaving = now >= artifact_.begins() && now < artifact_.dark(),
            .language_brightness = language.brightness};
}

} // namespace frustumscreen::exhibit
