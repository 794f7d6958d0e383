#include "app/settings/toml_file.h"

#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace frustumscreen::settings {

namespace {

/// The first line, counted from 1, that is not UTF-8; nullopt if all are. A zero byte counts as an error: it
/// is half of a character in UTF-16.
std::optional<std::size_t> line_that_is_not_utf8(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t bytes = character_bytes(text.substr(at));
        if (bytes == 0 || text[at] == '\0') {
            const auto before = text.substr(0, at);
            return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
        }
        at += bytes;
    }
    return std::nullopt;
}

/// Each dot of a key nests a table, and toml++ destroys tables by recursion: this bounds the depth.
constexpr std::size_t max_dots = 5000;

/// The end of the string or comment that begins at `at`; `at` itself if none begins there.
std::size_t end_of_text(std::string_view text, std::size_t at) {
    const auto after = [&](std::string_view end, std::size_t from) {
        const std::size_t found = text.find(end, from);
        return found == std::string_view::npos ? text.size() : found + end.size();
    };
    if (text[at] == '#') {
        return after("\n", at);
    }
    if (text[at] == '\'') {
        const bool many_lines = text.substr(at, 3) == "'''";
        return many_lines ? after("'''", at + 3) : std::min(after("'", at + 1), after("\n", at + 1));
    }
    if (text[at] != '"') {
        return at;
    }
    const std::string_view quotes = text.substr(at, 3) == "\"\"\"" ? "\"\"\"" : "\"";
    for (at += quotes.size(); at < text.size(); ++at) {
        if (text.substr(at, quotes.size()) == quotes) {
            return at + quotes.size();
        }
        if (text[at] == '\n' && quotes.size() == 1) {
            return at;
        }
        at += text[at] == '\\' ? 1 : 0; // skips the escaped letter too
    }
    return text.size();
}

/// Whether the dot at `at` is a number's and no key's: "1.5" before a comma, a bracket or the line's end. The last dot of
/// a header, "[1.5]", counts as a number's too.
bool is_decimal_point(std::string_view text, std::size_t at) {
    const auto is_digit = [&](std::size_t k) { return k < text.size() && text[k] >= '0' && text[k] <= '9'; };
    if (at == 0 || !is_digit(at - 1) || !is_digit(at + 1)) {
        return false;
    }
    const std::size_t end = std::min(text.find_first_not_of("0123456789_eE+-", at + 1), text.size());
    const std::size_t next = text.find_first_not_of(" \t", end);
    return next == std::string_view::npos ||
           std::string_view(",]}\r\n#").find(text[next]) != std::string_view::npos;
}

/// The dots of keys; strings, comments and numbers may have any number of dots.
std::size_t dots_of_keys(std::string_view text) {
    std::size_t dots = 0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = end_of_text(text, at);
        dots += end == at && text[at] == '.' && !is_decimal_point(text, at) ? 1 : 0;
        at = std::max(end, at + 1);
    }
    return dots;
}

} // namespace

void read_toml(ReadState& state, std::string_view text, std::uintmax_t max_bytes,
               const std::function<void(const toml::table&)>& read) {
    if (text.size() > max_bytes) {
        state.refuse("toml.too_long", 0,
                     fmt::format("is {} bytes; allowed are at most {}", text.size(), max_bytes));
        return;
    }
    if (const std::optional<std::size_t> line = line_that_is_not_utf8(text)) {
        state.refuse("toml.not_utf8", static_cast<std::uint32_t>(*line),
                     "is not UTF-8; save the file as UTF-8");
        return;
    }
    if (const std::size_t dots = dots_of_keys(text); dots > max_dots) {
        state.refuse("toml.too_many_dots", 0,
                     fmt::format("holds {} dots in keys; allowed are at most {}", dots, max_dots));
        return;
    }
    try {
        read(toml::parse(text));
    } catch (const toml::parse_error& error) {
        state.refuse("toml.syntax", static_cast<std::uint32_t>(error.source().begin.line),
                     fmt::format("is not TOML ({}); write each key once, as key = 1.5 or key = \"text\"",
                                 printable(error.description(), 200)));
    } catch (const std::exception& error) {
        state.refuse("toml.unreadable", 0, fmt::format("cannot be read: {}", printable(error.what(), 200)));
    }
}

} // namespace frustumscreen::settings
