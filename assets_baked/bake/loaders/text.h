/// Reads words and numbers from text files, independent of the locale.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace frustumscreen {

/// Reads words separated by blanks and line ends; keeps the line number for messages.
class WordReader {
public:
    explicit WordReader(std::string_view text) : text_(text) {}

    /// The next word, empty at the end of the text.
    [[nodiscard]] std::string_view next();
    /// The rest of the current line, without its end.
    [[nodiscard]] std::string_view rest_of_line();
    [[nodiscard]] std::size_t line() const { return line_; }
    /// In the text, in bytes.
    [[nodiscard]] std::size_t position() const { return position_; }

private:
    std::string_view text_;
    std::size_t position_ = 0;
    std::size_t line_ = 1;
};

/// The whole word as a number. "nan" and "inf" are accepted here; callers that need a finite number refuse them.
[[nodiscard]] std::optional<double> number_from(std::string_view word);
[[nodiscard]] std::optional<std::int64_t> whole_from(std::string_view word);
[[nodiscard]] bool is_blank(char c);

} // namespace frustumscreen
