/// What the exhibit shows: which artifact, in which language, how bright.
///
/// A change of artifact fades the old one out and the new one in, 0.2 s each (app/exhibit/fade.h).
///
/// Time     `now` never goes back.
/// Threads  values; one caller. `at` is pure.
/// Errors   none. An exhibit without artifacts shows nothing.
#pragma once

#include "app/exhibit/fade.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

enum class Wish { PreviousArtifact, NextArtifact, NextLanguage };

inline constexpr Nanoseconds fade_time = std::chrono::milliseconds(200); ///< out, and again in

struct Shown {
    std::size_t artifact = 0;
    double brightness = 0.0; ///< 0..1, a factor on linear light
    bool changing = false;   ///< brightness moves
};

class Exhibit {
public:
    /// `languages` (BCP 47): those that some artifact has a caption in, in the order the button goes through.
    Exhibit(std::size_t artifact_count, std::vector<std::string> languages, std::string language,
            MonotonicTime now);

    void wish(Wish wish, MonotonicTime now);
    /// As if the latest such wish had not been.
    void take_back(Wish wish, MonotonicTime now);
    /// There is something to change to.
    [[nodiscard]] bool heeds(Wish wish) const;
    [[nodiscard]] Shown at(MonotonicTime now) const;
    [[nodiscard]] const std::string& language() const { return language_; }

private:
    std::size_t count_;
    std::vector<std::string> languages_;
    std::string language_;
    std::string language_before_; ///< before the latest wish for another
    Fade fade_;                   ///< of artifacts
};

/// Index of the caption for `language` among captions in `languages`: the same tag, else the same language
/// with another region or script, else English, else the first. `languages` is not empty.
[[nodiscard]] std::size_t caption_for(std::string_view language, std::span<const std::string> languages);
/// One of them is this language, with this region and script or others.
[[nodiscard]] bool has_language(std::span<const std::string> languages, std::string_view language);

} // namespace frustumscreen
