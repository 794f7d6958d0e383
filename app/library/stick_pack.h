/// A pack on a stick, and its fate.
///
/// Threads  values and pure functions; any.
#pragma once

#include "app/library/import_failure.h"
#include "app/library/set_file.h"

#include <functional>
#include <string>
#include <vector>

namespace frustumscreen::library {

struct StickPack {
    std::string path;       ///< on the stick
    InstalledPack pack;     ///< as far as known: the copy adds file and sha256
    bool is_signed = false; ///< false: it is unsigned, which is allowed
    ImportedPack told;      ///< its line for the table
    bool is_double = false; ///< another pack of the stick has the same contents and is taken instead
    bool mends = false;     ///< it is installed, but its file is damaged or missing
    bool clashes = false;   ///< another pack has its id and serial, but other contents
    [[nodiscard]] bool is_wanted() const {
        return told.outcome == ImportOutcome::Pending || told.outcome == ImportOutcome::Taken;
    }
};

void refuse(ImportedPack& told, const ImportFailure& failure);
/// The line of a pack that the set file removes.
[[nodiscard]] ImportedPack removed_line(const InstalledPack& pack);

/// True if two packs are the same artifact: they have the same id, or both have none and their contents are the
/// same.
[[nodiscard]] bool is_same_artifact(const InstalledPack& a, const InstalledPack& b);

/// True if an installed pack's file is there and undamaged.
using IsSound = std::function<bool(const InstalledPack& pack)>;
/// Decides which of the pending packs are already there, and which are older than `shown` or than the highest
/// serial in `known`. A pack whose installed file is damaged does not count as there: it is copied again.
void weigh_packs(std::vector<StickPack>& packs, const InstalledSet& shown, const SetFile& known,
                 const IsSound& is_sound);
/// The order in which packs are copied: the highest serial first.
[[nodiscard]] std::vector<std::size_t> copy_order(const std::vector<StickPack>& packs);
/// Decides whether a pending pack is replaced by another one of the stick that was taken.
void weigh_against_taken(StickPack& pack, const std::vector<StickPack>& packs);
/// Takes nothing of the stick: each pack that would have been taken, and each of its doubles, gets this reason.
void refuse_all(std::vector<StickPack>& packs, const ImportFailure& failure);

} // namespace frustumscreen::library
