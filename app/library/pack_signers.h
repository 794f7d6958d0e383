/// The signers of the installed packs, and whether their keys are still valid.
///
/// An installed pack was checked when it was taken, and its file is named by its hash, so its signature is not
/// checked again.
///
/// Errors   none: a pack whose file cannot be read is left out.
/// Threads  one caller; of each file, only the directory and the signature are read.
#pragma once

#include "app/library/set_file.h"
#include "app/pack/signature/signature.h"
#include "firmware_host/base/file_tree.h"

#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::library {

/// Id of the signing key as text_of_key_id gives it; none: the pack is unsigned, or cannot be read.
[[nodiscard]] std::optional<std::string> signing_key(FileTree& library, const InstalledPack& pack);

/// True if a signature by this key is accepted today. `counting`: as trusted_keys.h. `today`: none: no key has
/// expired.
[[nodiscard]] bool counts_today(std::span<const pack::TrustedKey> counting, std::string_view key_id,
                                std::optional<std::chrono::sys_days> today);

/// The packs that were signed with a key that has stopped counting, by id, or by title if they have no id.
[[nodiscard]] std::vector<std::string> packs_of_ended_keys(FileTree& library, const InstalledSet& set,
                                                           std::span<const pack::TrustedKey> counting,
                                                           std::optional<std::chrono::sys_days> today);

/// "vase, bowl and 3 more"
[[nodiscard]] std::string names_in_words(std::span<const std::string> names);

} // namespace frustumscreen::library
