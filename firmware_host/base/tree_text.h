/// Reads and replaces whole small files of a tree.
///
/// Threads  one caller.
/// Errors   as FileTree.
#pragma once

#include "firmware_host/base/file_tree.h"

#include <string>
#include <string_view>

namespace frustumscreen {

/// EFBIG: the file has more than `max_bytes`.
[[nodiscard]] FileResult<std::string> read_text(FileTree& tree, std::string_view path, std::size_t max_bytes);
/// Writes the file `next`, syncs it, and renames it to `path`. Only sync_folder puts the new name on the
/// disk.
[[nodiscard]] FileResult<void> replace_text(WritableTree& tree, std::string_view path, std::string_view next,
                                            std::string_view text);

} // namespace frustumscreen
