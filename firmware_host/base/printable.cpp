#include "firmware_host/base/printable.h"

namespace frustumscreen {

// Unicode 15, table 3-7.
std::size_t character_bytes(std::string_view text) {
    const auto byte = [&](std::size_t k) {
        return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U;
    };
    const auto follows = [&](std::size_t k) { return (byte(k) & 0xC0U) == 0x80U; };
    const unsigned lead = byte(0);
    if (lead < 0x80) {
        return 1;
    }
    if (lead >= 0xC2 && lead <= 0xDF) {
        return follows(1) ? 2 : 0;
    }
    if (lead >= 0xE0 && lead <= 0xEF) {
        const bool shortest = lead != 0xE0 || byte(1) >= 0xA0;
        const bool surrogate = lead == 0xED && byte(1) >= 0xA0;
        return follows(1) && follows(2) && shortest && !surrogate ? 3 : 0;
    }
    if (lead >= 0xF0 && lead <= 0xF4) {
        const bool shortest = lead != 0xF0 || byte(1) >= 0x90;
        const bool in_range = lead != 0xF4 || byte(1) < 0x90;
        return follows(1) && follows(2) && follows(3) && shortest && in_range ? 4 : 0;
    }
    return 0;
}

bool is_control(std::string_view character) {
    const auto lead = static_cast<unsigned char>(character[0]);
    return lead < 0x20 || lead == 0x7F ||
           (character.size() == 2 && lead == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0);
}

bool directs_lines(std::string_view character) {
    return character == "\u2028" || character == "\u2029" || (character >= "\u202A" && character <= "\u202E");
}

std::string printable(std::string_view text, std::size_t longest) {
    std::string line;
    while (!text.empty()) {
        const std::size_t bytes = character_bytes(text);
        const std::string_view character = text.substr(0, bytes);
        const std::string_view shown =
            bytes == 0 || is_control(character) || directs_lines(character) ? "?" : character;
        if (line.size() + shown.size() > longest) {
            return line + "...";
        }
        line += shown;
        text.remove_prefix(bytes == 0 ? 1 : bytes);
    }
    return line;
}

} // namespace frustumscreen
