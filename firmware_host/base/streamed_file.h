/// A file that is written piece by piece, where holding all of it would take too much memory, and appears by rename all the same:
/// complete or not at all.
///
/// Threads  one caller.
/// Errors   as write_file.
#pragma once

#include "firmware_host/base/result.h"

#include <filesystem>
#include <functional>

namespace frustumscreen {

/// `write` fills the empty file; where it fails, nothing is left behind, and its error is told.
[[nodiscard]] Result<void> write_file_with(const std::filesystem::path& path,
                                           const std::function<Result<void>(int descriptor)>& write);

} // namespace frustumscreen
