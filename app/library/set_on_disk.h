/// set.txt and the exhibit's verdict during an import, and which of the sets is certainly on the disk.
///
/// Order    library_folder.h. Files of packs are removed only while it is certain which set.txt is on the disk.
/// Threads  one caller.
/// Errors   those of the kiosk's disk.
#pragma once

#include "app/library/import_failure.h"
#include "app/library/set_file.h"
#include "firmware_host/base/file_tree.h"

#include <optional>

namespace frustumscreen::library {

class SetOnDisk {
public:
    /// The folder must outlive it.
    explicit SetOnDisk(WritableTree& library) : library_(library) {}

    /// Reads both files.
    [[nodiscard]] ImportResult<void> read();
    /// Puts what was read onto the disk for certain, and removes what it does not name.
    [[nodiscard]] ImportResult<void> settle();
    /// Reads the verdict again: the exhibit may have reached one during the copy.
    [[nodiscard]] ImportResult<void> read_verdict_again();

    /// Replaces set.txt; the shown set stays the same.
    [[nodiscard]] ImportResult<void> rewrite(SetFile next);
    /// If the current set is good, no older set is needed, and the files of older packs may go.
    [[nodiscard]] ImportResult<void> forget_older_sets();
    /// Replaces set.txt by another set. If it cannot be told whether the new one is on the disk, this succeeds, and
    /// is_unsure() is true.
    [[nodiscard]] ImportResult<void> switch_set(SetFile next);
    /// Removes the packs that the set on the disk does not name, if it is certain which set that is.
    void clear_away_if_sure();

    [[nodiscard]] const SetFile& known() const { return known_; }
    [[nodiscard]] const std::optional<SetVerdict>& verdict() const { return verdict_; }
    [[nodiscard]] const InstalledSet& shown() const { return set_to_show(known_.choice, verdict_); }
    [[nodiscard]] bool is_unsure() const { return is_unsure_; }

private:
    WritableTree& library_;
    SetFile known_;
    std::optional<SetVerdict> verdict_;
    bool may_clear_away_ = false; ///< known_ is on the disk
    bool is_unsure_ = false;      ///< known_ is shown, but may not be on the disk
};

} // namespace frustumscreen::library
