/// The checks common to all TOML files that a person writes: size, encoding, depth, syntax.
///
/// Errors   one line in `ReadState`: file, line, what is wrong, what is allowed.
/// Threads  pure; any.
#pragma once

#include "app/settings/table_reader.h"

#include <functional>

namespace frustumscreen::settings {

/// Passes the file's table to `read`, or keeps in `state` why there is none; an exception from `read` is kept there
/// too.
void read_toml(ReadState& state, std::string_view text, std::uintmax_t max_bytes,
               const std::function<void(const toml::table&)>& read);

} // namespace frustumscreen::settings
