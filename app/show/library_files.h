/// The installed set's files as the exhibit reads and writes them: set.txt, and the verdict beside it.
///
/// Threads  any, never in a frame.
/// Errors   one sentence: a file that cannot be read or is none of ours, a folder that cannot be written.
#pragma once

#include "app/library/installed_set.h"
#include "app/settings/settings.h"
#include "app/show/set_trial.h"
#include "app/show/shown_set.h"
#include "firmware_host/base/result.h"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

namespace frustumscreen {

/// Which file set.txt is: it is only ever replaced. Two files that are told apart are equal in all of it by chance alone.
struct FileStamp {
    std::uint64_t device = 0, inode = 0, bytes = 0;
    std::int64_t changed_s = 0, changed_ns = 0;
    [[nodiscard]] bool operator==(const FileStamp&) const = default;
};
/// None: it is not there.
[[nodiscard]] std::optional<FileStamp> stamp_of_set(const std::filesystem::path& library);
/// Nothing: there is no set.txt.
[[nodiscard]] Result<std::optional<SetChoice>> read_choice(const std::filesystem::path& library);
/// Nothing: there is none, or it cannot be used, as after a power cut: then the set is on trial anew.
[[nodiscard]] std::optional<SetVerdict> read_verdict(const std::filesystem::path& library);
[[nodiscard]] Result<void> keep_verdict(const std::filesystem::path& library, const SetVerdict& verdict);

/// The packs of `set` that were signed with a key that is no longer trusted, in words; empty: there are none, or the settings
/// name no key, so that none is asked for.
[[nodiscard]] std::string packs_of_ended_keys(const std::filesystem::path& library, const InstalledSet& set,
                                              const Settings& settings,
                                              std::optional<std::chrono::sys_days> clock);

/// What the exhibit knows when it starts.
struct LibraryStart {
    std::optional<SetTrial> trial; ///< none: no set is installed
    std::string trouble;           ///< a sentence; empty: all is well
};
/// Counts the start. Where it cannot be counted, a set on trial makes way for the one before.
[[nodiscard]] LibraryStart start_library(const std::filesystem::path& library, Trust trust = Trust::Newest);

/// A set without packs shows those of the settings.
[[nodiscard]] SetRequest request_of(const InstalledSet& set, const std::filesystem::path& library,
                                    const Settings& settings);
/// Why a set that shows this is not good, a sentence; empty: it is well so far.
[[nodiscard]] std::string fault_of(const PacksLeftOut& left_out, bool shows_nothing);

} // namespace frustumscreen
