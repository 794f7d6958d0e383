/// frustumscreen-pack keygen: a pair of keys in minisign's format, the secret one with a password.
///
/// Errors   one sentence: a file is there already or cannot be written; no password.
/// Threads  one caller.
#pragma once

#include "firmware_host/base/result.h"

#include <string>

namespace frustumscreen {

/// Writes NAME.key (mode 0600) and NAME.pub, and says what they are for.
[[nodiscard]] Result<void> make_keys(const std::string& name);

} // namespace frustumscreen
