/// A pack on a stick, and what becomes of it.
///
/// Threads  values and pure functions; any.
#pragma once

#include "app/library/import_failure.h"
#include "app/library/set_file.h"

#include <functional>
#include <string>
#include <vector>

namespace frustumscreen {

struct StickPack {
    std::string path;       ///< on the stick
    InstalledPack pack;     ///< as far as it is known: file and sha256 come with the copy
    bool is_signed = false; ///< else unsigned packs are allowed
    ImportedPack told;      ///< what the table says
    bool is_double = false; ///< another one of the stick, which holds the same, stands in for it
    bool mends = false;     ///< it is installed, and its file is damaged or gone
    bool clashes = false;   ///< with one that has its id and serial and holds something else
    [[nodiscard]] bool is_wanted() const {
        return told.outcome == ImportOutcome::Pending || told.outcome == ImportOutcome::Taken;
    }
};

void refuse(ImportedPack& told, const ImportFailure& failure);
/// Of a pack that the set file removes.
[[nodiscard]] ImportedPack removed_line(const InstalledPack& pack);

/// Whether two packs are the same artifact: the same id, or neither has one and they hold the same.
[[nodiscard]] bool is_same_artifact(const InstalledPack& a, const InstalledPack& b);

/// Whether an installed pack's file is there and has its bytes.
using IsSound = std::function<bool(const InstalledPack& pack)>;
/// Decides, of the packs that are pending, which are there already or older: than `shown`, or than what was ever taken (`known`).
/// One whose installed file is damaged is not there: it is copied again.
void weigh_packs(std::vector<StickPack>& packs, const InstalledSet& shown, const SetFile& known,
                 const IsSound& is_sound);
/// The order in which packs are copied: of those with one id, the highest serial first.
[[nodiscard]] std::vector<std::size_t> copy_order(const std::vector<StickPack>& packs);
/// Decides of a pack that is still pending whether another of the stick, which was taken, stands in for it.
void weigh_against_taken(StickPack& pack, const std::vector<StickPack>& packs);
/// Nothing of the stick is taken, for this reason: each pack that would have been, and each that one of them stands in for, says so.
void refuse_all(std::vector<StickPack>& packs, const ImportFailure& failure);

} // namespace frustumscreen
