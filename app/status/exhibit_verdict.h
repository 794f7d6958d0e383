/// Whether the exhibit is well, as far as anybody can know from outside.
///
/// Threads  pure; any.
#pragma once

#include "app/status/known_exhibit.h"

#include <array>
#include <string>
#include <string_view>

namespace frustumscreen {

/// What the watchdog lets the exhibit show at its next start; the words of its status.
struct WatchdogMode {
    std::string_view word;
    std::string_view sentence;
};
inline constexpr std::array<WatchdogMode, 4> watchdog_modes{{
    {"normal", "lets the exhibit show what it wants"},
    {"last_good_set", "lets the exhibit show the last set of packs that was good"},
    {"built_in", "lets the exhibit show a built-in artifact"},
    {"safe", "shows the safe picture, with words for the staff"},
}};
/// `word` itself where it is no mode.
[[nodiscard]] std::string_view sentence_of_mode(std::string_view word);

struct ExhibitVerdict {
    bool runs = false; ///< its status is of now
    bool well =
        false; ///< it runs, an artifact is on the screen, and neither it nor its watchdog has a complaint
    std::string sentence;
};
[[nodiscard]] ExhibitVerdict verdict_of(const KnownExhibit& known);

} // namespace frustumscreen
