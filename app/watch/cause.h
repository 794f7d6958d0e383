/// Faults of the exhibit, in the words of the staff.
///
/// Threads  values; any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace frustumscreen::watch {

/// In order of precedence: of two faults, the first is handled.
enum class Cause : std::uint8_t {
    SafePictureFails, ///< it is requested, but not alive
    KeepsEnding,      ///< the exhibit's process ended repeatedly
    NoPicture,        ///< the exhibit runs, or should, but shows no live picture
    NothingToShow,    ///< the picture is alive, but no pack of the set can be shown
    MemoryShort,      ///< the exhibit takes more and more memory, or the machine has none left
    DeviceSilent,     ///< the tracker is plugged in and has worked, but now sends nothing
};
inline constexpr std::size_t cause_count = 6;

/// One word for programs and files: safe_picture_fails, keeps_ending, no_picture, nothing_to_show,
/// memory_short, device_silent.
[[nodiscard]] std::string_view word_of(Cause cause);
[[nodiscard]] std::optional<Cause> cause_named(std::string_view word);
/// A sentence without its full stop.
[[nodiscard]] std::string_view sentence_of(Cause cause);
/// As above, for the cause of an action; nullopt: ten good minutes.
[[nodiscard]] std::string_view sentence_of(const std::optional<Cause>& cause);
/// True if visitors see no picture, or no meaningful one.
[[nodiscard]] constexpr bool is_dark(Cause cause) {
    return cause != Cause::MemoryShort && cause != Cause::DeviceSilent;
}

} // namespace frustumscreen::watch
