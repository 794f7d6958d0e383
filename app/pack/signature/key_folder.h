/// Public keys as files: every `*.pub` of a folder, in minisign's format.
///
/// Threads  pure except for reading files; any.
/// Errors   one sentence: no such folder, a file that is not a public key, more than `max_trusted_keys`.
#pragma once

#include "app/pack/signature/signature.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <vector>

namespace frustumscreen::pack {

/// Reads one file. Messages begin with its name.
[[nodiscard]] Result<PublicKey> read_public_key(const std::filesystem::path& file);
/// In the order of their names; a key's name is its file's without `.pub`. None of them has a last day.
[[nodiscard]] Result<std::vector<TrustedKey>> read_key_folder(const std::filesystem::path& folder);

} // namespace frustumscreen::pack
