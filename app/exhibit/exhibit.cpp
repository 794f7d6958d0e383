#include "app/exhibit/exhibit.h"

#include "app/geometry/time_curves.h"

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
      change_start_(now - fade_time) {}

void Exhibit::wish(Wish wish, MonotonicTime now) {
    if (wish == Wish::NextLanguage) {
        if (!languages_.empty()) {
            const auto current = std::find(languages_.begin(), languages_.end(), language_);
            const bool last = current == languages_.end() || current + 1 == languages_.end();
            language_ = last ? languages_.front() : *(current + 1);
        }
        return;
    }
    if (count_ > 1) {
        change_to((to_ + (wish == Wish::NextArtifact ? 1 : count_ - 1)) % count_, now);
    }
}

void Exhibit::change_to(std::size_t artifact, MonotonicTime now) {
    const Nanoseconds elapsed = now - change_start_;
    if (elapsed < fade_time) {
        to_ = artifact; // still fading out: only the goal is another
        return;
    }
    from_ = std::exchange(to_, artifact);
    // A fade-in that is not over turns round at the brightness it has reached.
    change_start_ = elapsed < 2 * fade_time ? now - (2 * fade_time - elapsed) : now;
}

Shown Exhibit::at(MonotonicTime now) const {
    if (count_ == 0) {
        return {};
    }
    const double phase = to_seconds(now - change_start_) / to_seconds(fade_time);
    if (phase < 1.0) {
        return {from_, 1.0 - ease(phase), true};
    }
    return {to_, ease(phase - 1.0), phase < 2.0};
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

} // namespace frustumscreen
