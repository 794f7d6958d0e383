/// A folder on disk as a WritableTree.
///
/// Threads  one caller.
#pragma once

#include "firmware_host/base/file_tree.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <memory>

namespace frustumscreen {

/// Errors: missing, not a folder, cannot be opened. Messages begin with its name.
[[nodiscard]] Result<std::unique_ptr<WritableTree>> open_tree(const std::filesystem::path& folder);

} // namespace frustumscreen
