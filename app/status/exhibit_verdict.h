/// Whether the exhibit is well, as far as anybody can know from outside.
///
/// Threads  pure; any.
#pragma once

#include "app/status/known_exhibit.h"

#include <string>
#include <string_view>

namespace frustumscreen {

/// What the watchdog does, by its mode's word; `word` itself where it is no mode.
[[nodiscard]] std::string_view sentence_of_mode(std::string_view word);

struct ExhibitVerdict {
    bool runs = false; ///< its status is of now
    bool well =
        false; ///< it runs, an artifact is on the screen, and neither it nor its watchdog has a complaint
    std::string sentence;
};
[[nodiscard]] ExhibitVerdict verdict_of(const KnownExhibit& known);

} // namespace frustumscreen
