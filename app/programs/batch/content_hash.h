/// SHA-256 of an object's inputs, to avoid baking it twice.
///
/// Errors   an unreadable file.
/// Threads  pure apart from reading; any. Files of any size, in little memory.
/// Library  libsodium.
#pragma once

#include "firmware_host/base/result.h"

#include <filesystem>
#include <span>
#include <string>

namespace frustumscreen::programs {

/// SHA-256 of the file's bytes: 64 hexadecimal digits, lower case.
[[nodiscard]] Result<std::string> hash_of_file(const std::filesystem::path& file);

/// For a single scan: hash of its bytes. For a folder: hash of the names and bytes of all its files, except hidden
/// ones.
[[nodiscard]] Result<std::string> hash_of_object(const std::filesystem::path& input);

/// Hash of several texts, unambiguous for their boundaries.
[[nodiscard]] std::string hash_of_texts(std::span<const std::string> texts);

} // namespace frustumscreen::programs
