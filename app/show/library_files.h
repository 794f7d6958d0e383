/// The installed set's files as the exhibit reads and writes them: set.txt and the verdict.
///
/// Threads  any, never in a frame.
/// Errors   one sentence: a file that cannot be read or has another format, a folder that cannot be written.
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

namespace frustumscreen::show {

/// Identity of a set.txt, which is only ever replaced. Two different files have equal stamps only by coincidence.
struct FileStamp {
    std::uint64_t device = 0, inode = 0, bytes = 0;
    std::int64_t changed_s = 0, changed_ns = 0;
    [[nodiscard]] bool operator==(const FileStamp&) const = default;
};
/// None: there is no set.txt.
[[nodiscard]] std::optional<FileStamp> stamp_of_set(const std::filesystem::path& library);
/// nullopt: there is no set.txt.
[[nodiscard]] Result<std::optional<library::SetChoice>> read_choice(const std::filesystem::path& library);
/// nullopt: there is none, or it is unusable, as after a power cut; then the set's trial starts again.
[[nodiscard]] std::optional<library::SetVerdict> read_verdict(const std::filesystem::path& library);
[[nodiscard]] Result<void> keep_verdict(const std::filesystem::path& library,
                                        const library::SetVerdict& verdict);

/// The packs of `set` that are signed with an expired key, in words; empty: there are none, or the settings name no
/// key, so that none is required.
[[nodiscard]] std::string packs_of_ended_keys(const std::filesystem::path& library,
                                              const library::InstalledSet& set,
                                              const settings::Settings& settings,
                                              std::optional<std::chrono::sys_days> clock);

/// The state of the library when the exhibit starts.
struct LibraryStart {
    std::optional<SetTrial> trial; ///< none: no set is installed
    std::string trouble;           ///< a sentence; empty: no trouble
};
/// Counts the start. If it cannot be counted, a set on trial is replaced by the previous one.
[[nodiscard]] LibraryStart start_library(const std::filesystem::path& library, Trust trust = Trust::Newest);

/// The request for a set. A set without packs shows those of the settings.
[[nodiscard]] SetRequest request_of(const library::InstalledSet& set, const std::filesystem::path& library,
                                    const settings::Settings& settings);
/// Why a set that shows this is bad, as a sentence; empty: no fault so far.
[[nodiscard]] std::string fault_of(const library::UnshownPacks& left_out, bool shows_nothing);

} // namespace frustumscreen::show
