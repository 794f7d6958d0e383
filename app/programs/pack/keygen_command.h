/// frustumscreen-pack keygen: makes a pair of keys in minisign's format; a password encrypts the secret one.
///
/// Errors   one sentence: a file exists already or cannot be written; no password is given.
/// Threads  one caller.
#pragma once

#include "firmware_host/base/result.h"

#include <string>

namespace frustumscreen::programs {

/// Writes NAME.key (mode 0600) and NAME.pub, and prints their use.
[[nodiscard]] Result<void> make_keys(const std::string& name);

} // namespace frustumscreen::programs
