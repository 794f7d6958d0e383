/// The new set, from the set that is shown, the packs of a stick and its set file.
///
/// Rules    a pack whose id is in the set replaces that pack in its place; others are appended in the order of
///          their names on the stick. With a set file, the packs it names come first, in its order, and all must be
///          there. A stick with a set file is taken whole or not at all.
/// Threads  pure; any.
#pragma once

#include "app/library/exhibit_file.h"
#include "app/library/stick_pack.h"

#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::library {

struct PlannedSet {
    InstalledSet set; ///< has the number of `shown`
    std::vector<InstalledPack> removed;
};

/// Adds the wanted ones of `packs`. `unread`: refused packs and folders whose contents are unknown; any of them may
/// hold a pack of the set. `file`: none: the stick has only packs. Errors: why nothing of the stick is taken.
[[nodiscard]] tl::expected<PlannedSet, ImportFailure> plan_set(const InstalledSet& shown,
                                                               std::span<const StickPack> packs,
                                                               std::span<const ImportedPack> unread,
                                                               const std::optional<ExhibitFile>& file);

} // namespace frustumscreen::library
