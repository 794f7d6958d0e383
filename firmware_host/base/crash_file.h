/// The files that hold the last crashes: written by service/crash_record.h, which has their format, and read by app/watch/crash.h.
///
/// Threads  pure; any.
#pragma once

#include <string>

namespace frustumscreen {

inline constexpr int crash_file_count = 3;
inline constexpr const char* crash_file_begin = "frustumscreen-crash-1"; ///< its first line

/// `number`: 1 to `crash_file_count`.
[[nodiscard]] inline std::string crash_file_name(int number) {
    return "crash_" + std::to_string(number);
}

} // namespace frustumscreen
