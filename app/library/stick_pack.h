/// A pack on a stick, and what becomes of it.
///
/// Threads  values and pure functions; any.
#pragma once

#include "app/library/import_failure.h"
#include "app/library/set_file.h"

#include <string>
#include <vector>

namespace frustumscreen {

struct StickPack {
    std::string path;       ///< on the stick
    InstalledPack pack;     ///< as far as it is known: file and sha256 come with the copy
    bool is_signed = false; ///< else unsigned packs are allowed
    ImportedPack told;      ///< what the table says
    [[nodiscard]] bool is_wanted() const {
        return told.outcome == ImportOutcome::Pending || told.outcome == ImportOutcome::Taken;
    }
};

void refuse(ImportedPack& told, const ImportFailure& failure);
/// Of a pack that the set file removes.
[[nodiscard]] ImportedPack removed_line(const InstalledPack& pack);

/// Whether two packs are the same artifact: the same id, or neither has one and they hold the same.
[[nodiscard]] bool is_same_artifact(const InstalledPack& a, const InstalledPack& b);

/// Decides, of the packs that are pending, which are there already or older: than `shown`, or than what was ever taken (`known`).
void weigh_packs(std::vector<StickPack>& packs, const InstalledSet& shown, const SetFile& known);
/// The order in which packs are copied: of those with one id, the highest serial first.
[[nodiscard]] std::vector<std::size_t> copy_order(const std::vector<StickPack>& packs);
/// Decides of a pack that is still pending whether another of the stick, which was taken, stands in for it.
void weigh_against_taken(StickPack& pack, const std::vector<StickPack>& packs);

} // namespace frustumscreen
