#include "assets_baked/texts/check_text.h"

#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::texts {

namespace {

bool overrides_order(char32_t code) {
    return code >= 0x202A && code <= 0x202E;
}
bool separates_lines(char32_t code) {
    return code == 0x2028 || code == 0x2029;
}

/// The reason to refuse a letter; empty if it is allowed.
std::string_view fault_of(std::string_view letter, char32_t code) {
    if (letter != "\n" && (is_control(letter) || separates_lines(code))) {
        return "is a control character; delete it, or use a line break";
    }
    if (overrides_order(code)) {
        return "overrides the order of the letters around it; delete it: right-to-left text is set properly "
               "without it";
    }
    return {};
}

std::string utf8_of(char32_t code) {
    const auto tail = [code](unsigned shift) {
        return static_cast<char>(0x80U | ((static_cast<unsigned>(code) >> shift) & 0x3FU));
    };
    const auto lead = [code](unsigned mark, unsigned shift) {
        return static_cast<char>(mark | (static_cast<unsigned>(code) >> shift));
    };
    if (code < 0x80) {
        return {lead(0, 0)};
    }
    if (code < 0x800) {
        return {lead(0xC0, 6), tail(0)};
    }
    if (code < 0x10000) {
        return {lead(0xE0, 12), tail(6), tail(0)};
    }
    return {lead(0xF0, 18), tail(12), tail(6), tail(0)};
}

} // namespace

char32_t code_point_of(std::string_view text) {
    const std::size_t bytes = character_bytes(text);
    const auto lead = static_cast<unsigned char>(text[0]);
    char32_t code = bytes <= 1 ? lead : lead & (0xFFU >> (bytes + 1));
    for (std::size_t k = 1; k < bytes; ++k) {
        code = (code << 6U) | (static_cast<unsigned char>(text[k]) & 0x3FU);
    }
    return code;
}

std::string named_letter(char32_t code) {
    const std::string letter = utf8_of(code);
    const bool shown = character_bytes(letter) > 0 && !is_control(letter) && !overrides_order(code) &&
                       !separates_lines(code);
    return shown ? fmt::format("'{}' (U+{:04X})", letter, static_cast<std::uint32_t>(code))
                 : fmt::format("U+{:04X}", static_cast<std::uint32_t>(code));
}

Result<void> check_shaped_text(std::string_view text) {
    if (text.size() > max_shaped_bytes) {
        return bad_input("text.too_long", "the text has {} bytes; allowed are {}: shorten it", text.size(),
                         max_shaped_bytes);
    }
    if (const auto breaks = std::count(text.begin(), text.end(), '\n');
        breaks >= static_cast<std::ptrdiff_t>(max_written_lines)) {
        return bad_input("text.too_many_lines", "the text has {} lines; allowed are {}: shorten it",
                         breaks + 1, max_written_lines);
    }
    std::size_t line = 1;
    std::size_t letter_number = 1;
    for (std::string_view rest = text; !rest.empty();) {
        const std::size_t bytes = character_bytes(rest);
        if (bytes == 0) {
            return bad_input("text.not_utf8",
                             "line {}, letter {}: byte {:#04x} is not UTF-8; save the text as UTF-8", line,
                             letter_number, static_cast<unsigned char>(rest[0]));
        }
        const char32_t code = code_point_of(rest);
        if (const std::string_view fault = fault_of(rest.substr(0, bytes), code); !fault.empty()) {
            return bad_input("text.letter", "line {}, letter {}: {} {}", line, letter_number,
                             named_letter(code), fault);
        }
        letter_number = rest[0] == '\n' ? 1 : letter_number + 1;
        line += rest[0] == '\n' ? 1 : 0;
        rest.remove_prefix(bytes);
    }
    return {};
}

} // namespace frustumscreen::texts
