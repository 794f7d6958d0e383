/// The installed set of packs: which files the exhibit shows, in which order, and what is known of each.
///
/// Files    all below one folder:
///          set.txt            first line `frustumscreen-set 1 SHA256`, the hash of all that follows: JSON
///                             (set_file.h). Replaced by rename. Only the importer writes it.
///          packs/SHA256.fspack  named by the hash of their bytes: a file is added or removed, never changed. Only
///                               the importer.
///          shown/verdict.json the exhibit's verdict on a set. Only the exhibit writes it.
/// Trial    a new set is on trial until the exhibit has shown it for 30 s without a fault. Until then `last_good`
///          stays. It comes back if the verdict is bad, or if the exhibit started with the set `max_starts` times
///          without a verdict.
/// Threads  pure; any.
/// Errors   one sentence: the file is not as described above.
#pragma once

#include "firmware_host/base/result.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::library {

struct InstalledPack {
    std::string file;         ///< relative to the folder
    std::string id;           ///< the artifact's id; empty: it has none
    std::string title;        ///< from the manifest
    std::uint64_t serial = 0; ///< of its signature; 0: unsigned
    std::string sha256;       ///< of the file
    std::uint64_t bytes = 0;
    std::string manifest_sha256{}; ///< of the manifest, which has the hashes of all parts
    [[nodiscard]] bool operator==(const InstalledPack&) const = default;
};
/// A text of the attract state.
struct AttractText {
    std::string language; ///< BCP 47
    std::string text;
    [[nodiscard]] bool operator==(const AttractText&) const = default;
};
struct InstalledSet {
    std::uint64_t number = 0;         ///< higher after each switch
    std::vector<InstalledPack> packs; ///< in the order of showing; none: the packs of the settings
    std::vector<AttractText> attract;
    [[nodiscard]] bool operator==(const InstalledSet&) const = default;
};

enum class TrialState : std::uint8_t { Trying, Good, Bad };
/// As the verdict and the status write it, in the order of TrialState.
inline constexpr std::array<std::string_view, 3> trial_state_names{"trying", "good", "bad"};
struct SetVerdict {
    std::uint64_t number = 0; ///< of the set
    TrialState state = TrialState::Trying;
    int starts = 0;     ///< of the exhibit with this set during its trial
    std::string reason; ///< why it is bad, a sentence
    [[nodiscard]] bool operator==(const SetVerdict&) const = default;
};
inline constexpr int max_starts = 3;

inline constexpr std::string_view set_file_name = "set.txt";
inline constexpr std::string_view packs_folder_name = "packs";
inline constexpr std::string_view verdict_file_name = "shown/verdict.json";

/// The part of set.txt that the exhibit needs.
struct SetChoice {
    InstalledSet set;
    std::optional<InstalledSet> last_good; ///< none: `set` was good, or no set is installed yet
};
/// The set that the exhibit shows if it is started now.
[[nodiscard]] const InstalledSet& set_to_show(const SetChoice& choice,
                                              const std::optional<SetVerdict>& verdict);

[[nodiscard]] Result<SetVerdict> parse_verdict(std::string_view json);
[[nodiscard]] std::string write_verdict(const SetVerdict& verdict);

} // namespace frustumscreen::library
