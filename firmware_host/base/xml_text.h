/// Escapes text for XML and HTML content, and for attributes in double quotes.
#pragma once

#include <string>
#include <string_view>

namespace frustumscreen {

/// Control characters, which XML forbids, become spaces.
[[nodiscard]] inline std::string xml_text(std::string_view words) {
    std::string text;
    for (const char c : words) {
        switch (c) {
        case '&':
            text += "&amp;";
            break;
        case '<':
            text += "&lt;";
            break;
        case '>':
            text += "&gt;";
            break;
        case '"':
            text += "&quot;";
            break;
        default:
            text += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
        }
    }
    return text;
}

} // namespace frustumscreen
