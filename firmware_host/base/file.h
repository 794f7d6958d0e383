/// Reads and writes whole files. A written file appears by rename: complete or not at all.
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

/// Errors: not there, not readable, not a regular file, larger than `limit_bytes`.
[[nodiscard]] Result<Bytes> read_file(const std::filesystem::path& path,
                                      std::uintmax_t limit_bytes = std::uintmax_t{4} << 30);

/// Writes beside `path`, fsyncs, renames over it. On any error nothing is left behind; a process that is killed
/// leaves `path`.part<its number>.
[[nodiscard]] Result<void> write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// For a small file that is renewed again and again, as a status is: as `write_file`, but where the disk is full, the bytes go over
/// those that are there, as far as these have room. Who reads it in that moment may find a mixture of both.
[[nodiscard]] Result<void> renew_file(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// Removes what killed processes left beside `path`; what a living process writes stays.
void clear_partial_files(const std::filesystem::path& path);

[[nodiscard]] std::span<const std::byte> as_bytes(std::string_view text);
[[nodiscard]] std::string_view as_text(std::span<const std::byte> bytes);

} // namespace frustumscreen
