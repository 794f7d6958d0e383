/// Checks that a text is UTF-8.
///
/// Threads  pure; any.
#pragma once

#include "firmware_host/base/printable.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>

namespace frustumscreen {

/// The first line, counted from 1, that is not UTF-8; nullopt if all are. A zero byte counts as an error: it
/// is half of a character in UTF-16.
[[nodiscard]] inline std::optional<std::size_t> line_that_is_not_utf8(std::string_view text) {
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

} // namespace frustumscreen
