/// SHA-256 of what an object is made of, so that a bake is not done twice.
///
/// Errors   a file that cannot be read.
/// Threads  pure apart from reading; any. Files of any size, in little memory.
/// Library  libsodium.
#pragma once

#include "firmware_host/base/result.h"

#include <filesystem>
#include <span>
#include <string>

namespace frustumscreen {

/// 64 hexadecimal digits, lower case, as of a file's own bytes.
[[nodiscard]] Result<std::string> hash_of_file(const std::filesystem::path& file);

/// Of a scan that lies alone: its own bytes. Of a folder: the names and bytes of all files in it, hidden ones left out.
[[nodiscard]] Result<std::string> hash_of_object(const std::filesystem::path& input);

/// Of several texts, so that no two lists of texts look alike.
[[nodiscard]] std::string hash_of_texts(std::span<const std::string> texts);

} // namespace frustumscreen
