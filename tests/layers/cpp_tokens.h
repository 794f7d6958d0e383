/// The tokens of a C++ text, as far as one needs them to see its declarations: identifiers and numbers whole, `::` as one, all else
/// character by character. Comments and preprocessor lines are left out; a string or a character is one token, "".
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::tests {

[[nodiscard]] std::vector<std::string> cpp_tokens(std::string_view text);

} // namespace frustumscreen::tests
