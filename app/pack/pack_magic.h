/// Whether a file begins as a pack does, broken or not. A program may replace such a file by a new pack
/// without asking.
///
/// Threads  any. Reads the file's first bytes; a file that is not there or not readable is no pack.
#pragma once

#include <filesystem>

namespace frustumscreen {

/// True if it begins with a local header of a ZIP container (APPNOTE 4.3.7) whose name is `manifest.json`.
[[nodiscard]] bool begins_as_pack(const std::filesystem::path& file);

} // namespace frustumscreen
