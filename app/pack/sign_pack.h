/// Adds a signature to a pack's container.
///
/// Threads  one caller.
/// Errors   as ZipReader: the pack must have been verified.
#pragma once

#include "firmware_host/base/file.h"
#include "firmware_host/base/open_file.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <span>
#include <string_view>

namespace frustumscreen::pack {

/// The pack with `signature` as its last entry, replacing an existing one. All other entries are copied as they are
/// packed.
[[nodiscard]] Result<Bytes> with_signature(std::span<const std::byte> pack, std::string_view signature);
/// The same from a file into `file`, which may be the same file, by rename and in little memory. Messages begin
/// with its name.
[[nodiscard]] Result<void> write_with_signature(OpenFile pack, std::string_view signature,
                                                const std::filesystem::path& file);

} // namespace frustumscreen::pack
