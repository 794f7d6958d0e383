/// Names of the files that hold the last crashes. service/crash_record.h writes them and documents their
/// format; app/watch/crash.h reads them.
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
