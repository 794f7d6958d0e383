/// Pieces of a page in HTML that needs no other file.
///
/// Threads  pure; any.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace frustumscreen {

/// RFC 4648, with padding.
[[nodiscard]] std::string base64(std::span<const std::byte> bytes);

/// `data:TYPE;base64,...`
[[nodiscard]] std::string data_address(std::string_view type, std::span<const std::byte> bytes);

/// A text with its line breaks, escaped.
[[nodiscard]] std::string html_lines(std::string_view text);

/// What a content security policy names an inline script or style by: `'sha256-...'`.
[[nodiscard]] std::string policy_hash(std::string_view content);

/// Bytes in the units that a person reads.
[[nodiscard]] std::string bytes_in_words(std::size_t bytes);

} // namespace frustumscreen
