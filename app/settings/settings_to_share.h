/// A kiosk's settings as a text to give away: without comments, which may name people.
///
/// Threads  pure; any.
/// Errors   one sentence: it is no TOML.
#pragma once

#include "firmware_host/base/result.h"

#include <string>
#include <string_view>

namespace frustumscreen::settings {

/// The text for the exhibit's makers: without the museum's keys, and with six digits of each number. `text`: that
/// of a kiosk.toml, right or wrong, in TOML. The tables are in the order of their names.
[[nodiscard]] Result<std::string> settings_to_share(std::string_view text);
/// The text for another kiosk: all values, exactly.
[[nodiscard]] Result<std::string> settings_without_comments(std::string_view text);

} // namespace frustumscreen::settings
