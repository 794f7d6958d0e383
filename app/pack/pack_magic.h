/// Tells whether a file begins like a pack, broken or not. A program may replace such a file with a new pack
/// without asking.
///
/// Threads  any. Reads the file's first bytes; a missing or unreadable file is no pack.
#pragma once

#include <filesystem>

namespace frustumscreen::pack {

/// True if the file begins with a local header of a ZIP container (APPNOTE 4.3.7) named `manifest.json`.
[[nodiscard]] bool begins_as_pack(const std::filesystem::path& file);

} // namespace frustumscreen::pack
