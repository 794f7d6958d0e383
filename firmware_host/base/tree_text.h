/// Small files of a tree, whole.
///
/// Threads  one caller.
/// Errors   as FileTree.
#pragma once

#include "firmware_host/base/file_tree.h"

#include <string>
#include <string_view>

namespace frustumscreen {

/// EFBIG: it has more than `most_bytes`.
[[nodiscard]] FileResult<std::string> read_text(FileTree& tree, std::string_view path,
                                                std::size_t most_bytes);
/// Written under the name `next`, synced, renamed to `path`. That the name is on the disk says sync_folder alone.
[[nodiscard]] FileResult<void> replace_text(WritableTree& tree, std::string_view path, std::string_view next,
                                            std::string_view text);

} // namespace frustumscreen
