/// A kiosk's settings as a text to give away: without comments, which may name people, and without keys.
///
/// Threads  pure; any.
/// Errors   one sentence: it is no TOML.
#pragma once

#include "firmware_host/base/result.h"

#include <string>
#include <string_view>

namespace frustumscreen::settings {

/// `text`: of a kiosk.toml, right or wrong, in TOML. The order of its tables is that of their names.
[[nodiscard]] Result<std::string> settings_to_share(std::string_view text);

} // namespace frustumscreen::settings
