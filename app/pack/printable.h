/// Outside text for a message or a terminal: one line, nothing that a terminal acts on.
#pragma once

#include <string>
#include <string_view>

namespace frustumscreen::pack_format {

/// Control characters and bytes outside ASCII as '?', cut to a readable length.
[[nodiscard]] inline std::string printable(std::string_view text, std::size_t longest = 100) {
    std::string result(text.substr(0, longest));
    for (char& c : result) {
        if (c < 0x20 || c > 0x7e) {
            c = '?';
        }
    }
    return text.size() > longest ? result + "..." : result;
}

} // namespace frustumscreen::pack_format
