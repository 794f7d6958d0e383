/// Describes, for a message, the value that a settings file has in place of an allowed one: 'the text "x"', '3', 'a list of 2'.
///
/// Threads  pure; any.
/// Errors   none.
#pragma once

#include <toml++/toml.h>

#include <string>

namespace frustumscreen::settings {

[[nodiscard]] std::string found(const toml::node& node);

} // namespace frustumscreen::settings
