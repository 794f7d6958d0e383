/// A language as the settings name it.
///
/// Threads  pure; any.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen {

/// Returns nothing if `tag` does not look like a BCP 47 tag: letters, then subtags of letters and digits.
[[nodiscard]] std::optional<std::string> parse_language_tag(std::string_view tag);

} // namespace frustumscreen
