#include "app/pack/pack_text.h"

#include "app/pack/container/limits.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace frustumscreen::pack {

namespace {

bool is_small_letter_or_digit(char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
}

/// The code point of a well-formed UTF-8 character.
std::uint32_t code_point(std::string_view character) {
    const auto byte = [&](std::size_t k) {
        return static_cast<std::uint32_t>(static_cast<unsigned char>(character[k]));
    };
    if (character.size() == 1) {
        return byte(0);
    }
    std::uint32_t code = byte(0) & (0xFFU >> (character.size() + 1));
    for (std::size_t k = 1; k < character.size(); ++k) {
        code = code << 6U | (byte(k) & 0x3FU);
    }
    return code;
}

/// Checks a text character by character for invalid ones.
class TextCheck {
public:
    explicit TextCheck(TextShape shape) : shape_(shape) {}

    [[nodiscard]] std::optional<std::string> fault_of(std::string_view character) {
        if (character == "\n" && shape_ == TextShape::Lines) {
            ++lines_;
            return lines_ > max_text_lines ? fmt::format("has more than {} lines; write less", max_text_lines)
                                           : end_of_line();
        }
        const std::uint32_t code = code_point(character);
        if (is_control(character)) {
            return fmt::format("has the control character U+{:04X}; remove it", code);
        }
        // Unicode Standard Annex 9, 2.
        if (code >= 0x202A && code <= 0x202E) {
            return fmt::format("has U+{:04X}, which turns the direction of the text by force; remove it",
                               code);
        }
        if (code >= 0x2066 && code <= 0x2068) {
            ++isolates_;
        } else if (code == 0x2069 && isolates_-- == 0) {
            return "has U+2069, which ends an isolate that did not begin; remove it";
        }
        return std::nullopt;
    }
    [[nodiscard]] std::optional<std::string> end_of_line() const {
        return isolates_ == 0 ? std::nullopt
                              : std::optional<std::string>(
                                    "has an isolate of a direction (U+2066 to U+2068) without its "
                                    "end, U+2069, in the same line; add or remove one");
    }

private:
    TextShape shape_;
    std::size_t lines_ = 1;
    int isolates_ = 0;
};

} // namespace

std::optional<std::string> fault_of_text(std::string_view text, TextShape shape) {
    const std::size_t most = shape == TextShape::Line ? max_line_bytes : max_text_bytes;
    if (text.size() > most) {
        return fmt::format("has {} bytes, allowed are {}; write less", text.size(), most);
    }
    TextCheck check(shape);
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t bytes = character_bytes(text.substr(at));
        if (bytes == 0) {
            return fmt::format("is not UTF-8 from byte {} on; save it as UTF-8", at);
        }
        if (std::optional<std::string> fault = check.fault_of(text.substr(at, bytes))) {
            return fault;
        }
        at += bytes;
    }
    return check.end_of_line();
}

bool has_language_form(std::string_view text) {
    const auto allowed = [](char c) {
        return is_small_letter_or_digit(c) || (c >= 'A' && c <= 'Z') || c == '-';
    };
    return text.size() >= 2 && text.size() <= max_language_bytes &&
           std::all_of(text.begin(), text.end(), allowed);
}

bool is_artifact_id(std::string_view text) {
    const auto allowed = [](char c) {
        return is_small_letter_or_digit(c) || c == '.' || c == '_' || c == '-';
    };
    return !text.empty() && text.size() <= max_id_bytes && is_small_letter_or_digit(text.front()) &&
           std::all_of(text.begin(), text.end(), allowed);
}

} // namespace frustumscreen::pack
