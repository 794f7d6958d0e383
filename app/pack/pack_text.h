/// What a text must be so that a pack may hold it: bounded, clean, and harmless to the texts beside it.
///
/// Threads  pure; any.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen {

enum class TextShape { Line, Lines }; ///< a title, a caption's text

/// Words that follow the text's name ("has 5000 bytes, allowed are 1000"); nothing if all is well.
[[nodiscard]] std::optional<std::string> fault_of_text(std::string_view text, TextShape shape);

/// Whether it has the form of a BCP 47 tag; whether there is such a language, parse_language_tag says.
[[nodiscard]] bool has_language_form(std::string_view text);

/// Whether it is an artifact's id: FORMAT.md, `identity`.
[[nodiscard]] bool is_artifact_id(std::string_view text);

} // namespace frustumscreen
