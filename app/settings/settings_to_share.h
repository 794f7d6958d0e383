/// A kiosk's settings as a text to give away: without comments, which may name people.
///
/// Threads  pure; any.
/// Errors   one sentence: it is no TOML.
#pragma once

#include "firmware_host/base/result.h"

#include <string>
#include <string_view>

namespace frustumscreen::settings {

/// `text`: of a kiosk.toml, right or wrong, in TOML. The order of its tables is that of their names.
/// For its makers: without the museum's keys, and with six digits of each number.
[[nodiscard]] Result<std::string> settings_to_share(std::string_view text);
/// For another kiosk: the same values.
[[nodiscard]] Result<std::string> settings_without_comments(std::string_view text);

} // namespace frustumscreen::settings
