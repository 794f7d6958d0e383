/// What set.txt says after an import: the new set with the one to go back to, and what must never be forgotten.
///
/// Threads  pure; any.
#pragma once

#include "app/library/set_plan.h"
#include "app/library/signed_exhibit_file.h"
#include "app/library/stick_pack.h"

#include <optional>
#include <vector>

namespace frustumscreen {

/// Keeps the serials of packs that are taken, the set file's, and the latest day on which any of these was signed.
void remember(SetFile& known, const std::vector<StickPack>& packs,
              const std::optional<SignedExhibitFile>& exhibit);

/// What a set that replaces the one of `choice` goes back to: that one if it was good, or if nothing is known to be better.
/// Without packs: those of the settings, as before the first set.
[[nodiscard]] InstalledSet set_to_go_back_to(const SetChoice& choice,
                                             const std::optional<SetVerdict>& verdict);

/// Whether the exhibit has come to this verdict on what is installed.
[[nodiscard]] bool is_judged(const SetFile& known, const std::optional<SetVerdict>& verdict, TrialState as);

/// Puts `set` in the place of what `known` has; its number is higher than any that the exhibit has judged, though set.txt may have
/// been removed.
void replace_set(SetFile& known, InstalledSet set, const std::optional<SetVerdict>& verdict);

} // namespace frustumscreen
