/// The rungs of the recovery ladder, and what they leave on the table.
///
/// Threads  values; any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace frustumscreen {

/// From the gentlest to the hardest; the last one leads down again.
enum class Step : std::uint8_t {
    RestartExhibit,
    ResetDevice, ///< the tracker's USB port
    LastGoodSet, ///< and a restart
    DrawPlainly, ///< with what a graphics driver does least (display/plain_drawing.h), and a restart
    BuiltIn,     ///< the built-in artifact with the last good settings, and a restart
    SafePicture, ///< words for the staff in the exhibit's place
    Reboot,
    Return, ///< to the exhibit's own set, after a degraded mode was good for long enough
};
inline constexpr std::size_t step_count = 8;

/// What the kiosk shows.
enum class Mode : std::uint8_t { Normal, LastGoodSet, Plain, BuiltIn, Safe };
inline constexpr std::size_t mode_count = 5;

/// One word: restart_exhibit, reset_device, last_good_set, draw_plainly, built_in, safe_picture, reboot, return.
[[nodiscard]] std::string_view word_of(Step step);
[[nodiscard]] std::optional<Step> step_named(std::string_view word);
/// What is done, a sentence without its full stop.
[[nodiscard]] std::string_view sentence_of(Step step);
/// One word: normal, last_good_set, plain, built_in, safe.
[[nodiscard]] std::string_view word_of(Mode mode);
/// What the watchdog does in it, as in: the watchdog ...
[[nodiscard]] std::string_view sentence_of(Mode mode);
[[nodiscard]] std::optional<Mode> mode_named(std::string_view word);

} // namespace frustumscreen
