/// A file that is written piece by piece, because the whole would take too much memory. It appears by rename,
/// either complete or not at all.
///
/// Threads  one caller.
/// Errors   as write_file.
#pragma once

#include "firmware_host/base/result.h"

#include <filesystem>
#include <functional>

namespace frustumscreen {

/// `write` fills the empty file. If it fails, no file is left behind, and its error is returned.
[[nodiscard]] Result<void> write_file_with(const std::filesystem::path& path,
                                           const std::function<Result<void>(int descriptor)>& write);

} // namespace frustumscreen
