/// Rules for a text in a pack: bounded, clean, and harmless to the texts beside it.
///
/// Threads  pure; any.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen::pack {

enum class TextShape { Line, Lines }; ///< a title, a caption's text

/// A phrase that follows the text's name ("has 5000 bytes, allowed are 1000"); nothing if the text is valid.
[[nodiscard]] std::optional<std::string> fault_of_text(std::string_view text, TextShape shape);

/// True if the text has the form of a BCP 47 tag; parse_language_tag tells whether the language exists.
[[nodiscard]] bool has_language_form(std::string_view text);

/// True if the text is an artifact's id: FORMAT.md, `identity`.
[[nodiscard]] bool is_artifact_id(std::string_view text);

} // namespace frustumscreen::pack
