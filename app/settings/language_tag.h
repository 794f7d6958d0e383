/// A language tag of the settings and captions.
///
/// Threads  pure; any.
/// Source   BCP 47 (RFC 5646); ISO 639-1.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen::settings {

inline constexpr std::string_view allowed_language_tags =
    "language tags such as \"en\" or \"de-CH\", which begin with a code of ISO 639";

/// `tag` in the usual case (RFC 5646, 2.1.1: "de-CH", "zh-Hant"), so that equal tags are equal texts. Nothing if it
/// is no BCP 47 tag (a language, then subtags of letters and digits), or if it begins with two letters that are no
/// language. Codes of three letters are not looked up.
[[nodiscard]] std::optional<std::string> parse_language_tag(std::string_view tag);

} // namespace frustumscreen::settings
