/// Who signed the packs that are installed, and whether that key still counts.
///
/// An installed pack was checked when it was taken, and its file is called by its hash: what its signature says is believed here.
///
/// Errors   none: of a pack whose file cannot be read nothing is said.
/// Threads  one caller; of each file the directory and the signature are read.
#pragma once

#include "app/library/set_file.h"
#include "app/pack/signature/signature.h"
#include "firmware_host/base/file_tree.h"

#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen {

/// Id of the key as text_of_key_id gives it; none: the pack is unsigned, or cannot be read.
[[nodiscard]] std::optional<std::string> signing_key(FileTree& library, const InstalledPack& pack);

/// Whether what it signs is taken today. `counting`: as trusted_keys.h; `today`: none: no key has ended.
[[nodiscard]] bool counts_today(std::span<const TrustedKey> counting, std::string_view key_id,
                                std::optional<std::chrono::sys_days> today);

/// Those that were signed with a key that is no longer trusted, by id, or by title where they have none.
[[nodiscard]] std::vector<std::string> packs_of_ended_keys(FileTree& library, const InstalledSet& set,
                                                           std::span<const TrustedKey> counting,
                                                           std::optional<std::chrono::sys_days> today);

/// "vase, bowl and 3 more"
[[nodiscard]] std::string names_in_words(std::span<const std::string> names);

} // namespace frustumscreen
