/// The set that comes of the one that is shown, the packs of a stick and its set file.
///
/// Rules    a pack with an id that is there replaces it in its place; others are appended in the order of their names on the
///          stick. With a set file: what it names comes first in its order, and must be there; a stick with a set file is taken
///          whole or not at all.
/// Threads  pure; any.
#pragma once

#include "app/library/exhibit_file.h"
#include "app/library/stick_pack.h"

#include <optional>
#include <span>
#include <vector>

namespace frustumscreen {

struct PlannedSet {
    InstalledSet set; ///< its number is that of `shown`
    std::vector<InstalledPack> removed;
};

/// Of `packs` those that are wanted come in. `unread`: packs and folders of which nothing is known but that they are refused; any of
/// them may hold what belongs to the set. `file`: none: packs alone. Errors: why nothing of the stick is taken.
[[nodiscard]] tl::expected<PlannedSet, ImportFailure> plan_set(const InstalledSet& shown,
                                                               std::span<const StickPack> packs,
                                                               std::span<const ImportedPack> unread,
                                                               const std::optional<ExhibitFile>& file);

} // namespace frustumscreen
