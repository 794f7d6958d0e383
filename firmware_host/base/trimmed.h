/// A text without the blanks around it.
///
/// Threads  pure; any.
/// Source   Unicode, White_Space; and the zero-width marks that editors leave behind.
#pragma once

#include <array>
#include <string_view>

namespace frustumscreen {

/// A part of `text`, UTF-8; empty if `text` has only blanks.
[[nodiscard]] inline std::string_view trimmed(std::string_view text) {
    constexpr std::array<std::string_view, 24> blanks{
        " ",      "\t",     "\n",     "\v",     "\f",     "\r",     "\u0085", "\u00a0",
        "\u1680", "\u2000", "\u2001", "\u2002", "\u2003", "\u2004", "\u2005", "\u2006",
        "\u2007", "\u2008", "\u2009", "\u200a", "\u200b", "\u202f", "\u3000", "\ufeff"};
    for (bool cut = true; cut;) {
        cut = false;
        for (const std::string_view blank : blanks) {
            if (text.starts_with(blank)) {
                text.remove_prefix(blank.size());
                cut = true;
            }
            if (text.ends_with(blank)) {
                text.remove_suffix(blank.size());
                cut = true;
            }
        }
    }
    return text;
}

} // namespace frustumscreen
