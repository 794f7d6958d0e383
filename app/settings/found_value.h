/// What a settings file has in place of an allowed value, in words for a message: 'the text "x"', '3', 'a list of 2'.
///
/// Threads  pure; any.
/// Errors   none.
#pragma once

#include <toml++/toml.h>

#include <string>

namespace frustumscreen::settings {

[[nodiscard]] std::string found(const toml::node& node);

} // namespace frustumscreen::settings
