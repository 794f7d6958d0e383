/// The installed set of packs, as the status reports it.
///
/// Threads  values that never change; any.
#pragma once

#include "app/library/installed_set.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::status {

struct SetStatus {
    std::uint64_t shown = 0; ///< number of the set on show; 0: the packs of the settings
    std::vector<library::InstalledPack> packs;
    library::SetVerdict newest; ///< of the latest installed set
    bool on_trial = false;      ///< `newest` has no verdict yet, and there is another set to go back to
    std::string of_ended_keys; ///< packs on show whose key has stopped counting (pack_signers.h); empty: none
    std::string trouble; ///< a sentence: set.txt or the verdict cannot be read or written; empty: no trouble
    [[nodiscard]] bool operator==(const SetStatus&) const = default;
};
using SharedSetStatus = std::shared_ptr<const SetStatus>;

/// Takes the place of SetStatus::trouble: the thread that fills in SetStatus is the one that hangs.
inline constexpr std::string_view library_hangs_sentence =
    "the library's disk does not answer; no other set can come until it answers";

/// For the journal and the service manager.
[[nodiscard]] std::string sentence_of(const SetStatus& status);

} // namespace frustumscreen::status
