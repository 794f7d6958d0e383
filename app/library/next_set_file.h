/// The contents of set.txt after an import: the new set, the set to go back to, and what must never be forgotten.
///
/// Threads  pure; any.
#pragma once

#include "app/library/set_plan.h"
#include "app/library/signed_exhibit_file.h"
#include "app/library/stick_pack.h"

#include <optional>
#include <vector>

namespace frustumscreen::library {

/// Records the serials of taken packs and of the set file, and the latest day on which any of these was signed.
void remember(SetFile& known, const std::vector<StickPack>& packs,
              const std::optional<SignedExhibitFile>& exhibit);

/// The set to go back to from a set that replaces that of `choice`: the one of `choice` if it was good, or if no
/// better is known. A set without packs stands for the packs of the settings.
[[nodiscard]] InstalledSet set_to_go_back_to(const SetChoice& choice,
                                             const std::optional<SetVerdict>& verdict);

/// True if the exhibit has come to this verdict on the installed set.
[[nodiscard]] bool is_judged(const SetFile& known, const std::optional<SetVerdict>& verdict, TrialState as);

/// Replaces the set of `known` by `set`. The new number is higher than any that the exhibit has judged, even if
/// set.txt has been removed in between.
void replace_set(SetFile& known, InstalledSet set, const std::optional<SetVerdict>& verdict);

} // namespace frustumscreen::library
