/// The files of `words/`, built into the program by CMake.
///
/// Threads  constants; any.
#pragma once

#include <span>
#include <string_view>

namespace frustumscreen::texts {

struct BuiltinWords {
    std::string_view language;
    std::string_view toml;
};

[[nodiscard]] std::span<const BuiltinWords> builtin_words();

} // namespace frustumscreen::texts
