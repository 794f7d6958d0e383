/// Formats a Sentence without allocating memory.
#pragma once

#include "firmware_host/base/sentence.h"

#include <fmt/format.h>

#include <utility>

namespace frustumscreen {

template <typename... Parts>
[[nodiscard]] Sentence format_sentence(fmt::format_string<Parts...> format, Parts&&... parts) {
    std::array<char, Sentence::longest + 1> text{}; // one more byte, which tells Sentence to cut
    const auto end = fmt::format_to_n(text.data(), text.size(), format, std::forward<Parts>(parts)...).out;
    return Sentence({text.data(), static_cast<std::size_t>(end - text.data())});
}

} // namespace frustumscreen
