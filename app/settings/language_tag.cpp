#include "app/settings/language_tag.h"

namespace frustumscreen {

std::optional<std::string> parse_language_tag(std::string_view tag) {
    std::size_t length = 0;
    bool first = true;
    for (const char c : tag) {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        if (c == '-' && length > 0) {
            first = false;
            length = 0;
        } else if (letter || (!first && c >= '0' && c <= '9')) {
            ++length;
        } else {
            return std::nullopt;
        }
        if (length > 8) {
            return std::nullopt;
        }
    }
    const bool well = length > 0 && tag.find('-') != 1 && !(first && length < 2);
    return well ? std::optional(std::string(tag)) : std::nullopt;
}

} // namespace frustumscreen
