/// What can be wrong with the exhibit, as a person would say it.
///
/// Threads  values; any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace frustumscreen {

/// In the order in which they are seen to: of two, the first one is.
enum class Cause : std::uint8_t {
    SafePictureFails, ///< it is wanted, and does not live
    KeepsEnding,      ///< the exhibit's process ended again and again
    NoPicture,        ///< the exhibit runs, or should, and no living picture comes of it
    NothingToShow,    ///< the picture lives; no pack of the set can be shown
    MemoryShort,      ///< the exhibit takes more and more memory, or the machine has none left
    DeviceSilent,     ///< the tracker is plugged in and was heard once, and says nothing any more
};
inline constexpr std::size_t cause_count = 6;

/// One word for programs and files: safe_picture_fails, keeps_ending, no_picture, nothing_to_show, memory_short, device_silent.
[[nodiscard]] std::string_view word_of(Cause cause);
[[nodiscard]] std::optional<Cause> cause_named(std::string_view word);
/// A sentence without its full stop.
[[nodiscard]] std::string_view sentence_of(Cause cause);
/// The same for what led to a step; none: ten good minutes.
[[nodiscard]] std::string_view sentence_of(const std::optional<Cause>& cause);
/// Whether the visitors see no picture, or none that means anything.
[[nodiscard]] constexpr bool is_dark(Cause cause) {
    return cause != Cause::MemoryShort && cause != Cause::DeviceSilent;
}

} // namespace frustumscreen
