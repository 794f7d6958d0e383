/// Reads and writes whole files. A written file appears by rename, either complete or not at all.
///
/// Threads  any; not two at once on one path.
#pragma once

#include "firmware_host/base/result.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace frustumscreen {

using Bytes = std::vector<std::byte>;

/// Errors: missing, not readable, not a regular file, larger than `limit_bytes`.
[[nodiscard]] Result<Bytes> read_file(const std::filesystem::path& path,
                                      std::uintmax_t limit_bytes = std::uintmax_t{4} << 30);

/// Writes a temporary file next to `path`, fsyncs it, and renames it to `path`. An error leaves no file
/// behind; a killed process leaves `path`.part<its number>.
[[nodiscard]] Result<void> write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// For a small file that is rewritten often, such as a status. As `write_file`, but if that fails and the
/// bytes fit into the existing file or the free space, they overwrite the file in place. A concurrent reader
/// may then see a mixture of old and new.
[[nodiscard]] Result<void> renew_file(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// Removes temporary files that killed processes left next to `path`; those of running processes stay.
void clear_partial_files(const std::filesystem::path& path);

[[nodiscard]] std::span<const std::byte> as_bytes(std::string_view text);
[[nodiscard]] std::string_view as_text(std::span<const std::byte> bytes);

} // namespace frustumscreen
