/// SHA-256 (FIPS 180-4), by libsodium.
#pragma once

#include <span>
#include <string>

namespace frustumscreen {

/// 64 hexadecimal digits, lower case.
[[nodiscard]] std::string sha256_hex(std::span<const std::byte> bytes);

} // namespace frustumscreen
