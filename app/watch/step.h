/// The actions of the recovery ladder, and the modes that they lead to.
///
/// Threads  values; any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace frustumscreen::watch {

/// From the mildest to the strongest; the last one leads back down.
enum class Step : std::uint8_t {
    RestartExhibit,
    ResetDevice, ///< the tracker's USB port
    LastGoodSet, ///< and a restart
    DrawPlainly, ///< with the most robust drawing (display/plain_drawing.h), and a restart
    BuiltIn,     ///< the built-in artifact with the last good settings, and a restart
    SafePicture, ///< a message to the staff in place of the exhibit
    Reboot,
    Return, ///< to the exhibit's own set, after a degraded mode was good for long enough
};
inline constexpr std::size_t step_count = 8;

/// The mode of the kiosk's picture.
enum class Mode : std::uint8_t { Normal, LastGoodSet, Plain, BuiltIn, Safe };
inline constexpr std::size_t mode_count = 5;

/// One word: restart_exhibit, reset_device, last_good_set, draw_plainly, built_in, safe_picture, reboot, return.
[[nodiscard]] std::string_view word_of(Step step);
[[nodiscard]] std::optional<Step> step_named(std::string_view word);
/// Description of the action, a sentence without its full stop.
[[nodiscard]] std::string_view sentence_of(Step step);
/// One word: normal, last_good_set, plain, built_in, safe.
[[nodiscard]] std::string_view word_of(Mode mode);
/// The watchdog's behaviour in this mode; completes "the watchdog ...".
[[nodiscard]] std::string_view sentence_of(Mode mode);
[[nodiscard]] std::optional<Mode> mode_named(std::string_view word);

} // namespace frustumscreen::watch
