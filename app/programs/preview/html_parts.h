/// Pieces of a self-contained HTML page.
///
/// Threads  pure; any.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace frustumscreen::programs {

/// RFC 4648, with padding.
[[nodiscard]] std::string base64(std::span<const std::byte> bytes);

/// `data:TYPE;base64,...`
[[nodiscard]] std::string data_address(std::string_view type, std::span<const std::byte> bytes);

/// A text with its line breaks, escaped.
[[nodiscard]] std::string html_lines(std::string_view text);

/// The name of an inline script or style in a content security policy: `'sha256-...'`.
[[nodiscard]] std::string policy_hash(std::string_view content);

/// A size in units for people.
[[nodiscard]] std::string bytes_in_words(std::size_t bytes);

} // namespace frustumscreen::programs
