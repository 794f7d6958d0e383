/// What the exhibit shows: which artifact, in which language, how bright.
///
/// A change of artifact fades the old one out and the new one in (app/exhibit/fade.h), a change of language
/// only the caption. What is wished for while something fades in begins when that is done, and artifact and
/// caption never fade one between the other: changes are at least 0.5 s apart, whatever is pressed. So the
/// picture flashes at most twice a second, which leaves room for the staff's pattern to come and go. Three
/// times is the limit of WCAG 2.3.1 and ITU-R BT.1702 for the sake of photosensitive people. A press still
/// shows at once: either the picture dims, or it is changing anyway.
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

inline constexpr Nanoseconds fade_time = std::chrono::milliseconds(250); ///< out, and again in

struct Shown {
    std::size_t artifact = 0;
    double brightness = 0.0;   ///< of the artifact: 0..1, a factor on linear light
    std::string_view language; ///< of the caption; stands as long as the exhibit
    double caption_brightness = 0.0;
    bool changing = false; ///< a brightness moves, or is about to
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
    /// That is wished for; its caption may be still to come.
    [[nodiscard]] const std::string& language() const { return languages_[language_.goal()]; }

private:
    void change_language(std::size_t which, MonotonicTime now);

    std::size_t count_;
    std::vector<std::string> languages_; ///< and one more, where it begins in none of them
    std::size_t language_count_;
    std::size_t language_before_; ///< before the latest wish for another
    Fade artifact_;
    Fade language_; ///< indices into `languages_`
};

/// Index of the caption for `language` among captions in `languages`: the same tag, else the same language
/// with another region or script, else English, else the first. `languages` is not empty.
[[nodiscard]] std::size_t caption_for(std::string_view language, std::span<const std::string> languages);
/// One of them is this language, with this region and script or others.
[[nodiscard]] bool has_language(std::span<const std::string> languages, std::string_view language);

} // namespace frustumscreen
