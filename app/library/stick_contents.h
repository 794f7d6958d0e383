/// The files that an import has found on a stick so far, and a line of the report for each.
///
/// Threads  values and pure functions; any.
#pragma once

#include "app/library/import_failure.h"
#include "app/library/import_stick.h"
#include "app/library/signed_exhibit_file.h"
#include "app/library/stick_pack.h"
#include "app/library/stick_walk.h"

#include <optional>
#include <vector>

namespace frustumscreen::library {

struct StickContents {
    StickFiles files;                         ///< its `refused` are those of which only the name is known
    std::optional<ImportedPack> exhibit_line; ///< none: the stick has no set file
    std::optional<SignedExhibitFile> exhibit; ///< none: there is none, or it is refused
    std::vector<StickPack> packs;
};

/// The lines in the order of the report: settings, copy and report of the kiosk, the set file, packs, misnamed files,
/// and the packs that the set file removes from the set.
[[nodiscard]] std::vector<ImportedPack> lines_of(const StickContents& contents, const ImportRequest& request,
                                                 const std::vector<InstalledPack>& removed);

/// Refuses the whole stick: says in each line that nothing of it was taken, and why.
void refuse_whole(StickContents& contents, const ImportFailure& failure);

} // namespace frustumscreen::library
