/// Writes a line to standard error with one write; without a reader the line is lost.
///
/// Threads  any.
/// Errors   none: a full disk behind standard error must not end the exhibit.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <string_view>

namespace frustumscreen {

/// `line` has no line break at its end; a line longer than 1000 bytes is cut.
inline void say_line(std::string_view program, std::string_view line) {
    std::array<char, 1000> text{};
    char* const end = fmt::format_to_n(text.data(), text.size() - 1, "{}: {}", program, line).out;
    *end = '\n';
    const auto size = static_cast<std::size_t>(end + 1 - text.data());
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), size);
}

} // namespace frustumscreen
