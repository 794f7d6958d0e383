#include "app/library/set_on_disk.h"

#include "app/library/library_folder.h"
#include "app/library/next_set_file.h"

#include <utility>

namespace frustumscreen::library {

ImportResult<void> SetOnDisk::read() {
    TRY(known_, read_set_file(library_));
    return read_verdict_again();
}

ImportResult<void> SetOnDisk::read_verdict_again() {
    TRY(verdict_, read_verdict(library_));
    return {};
}

ImportResult<void> SetOnDisk::settle() {
    if (const FileResult<void> settled = frustumscreen::library::settle(library_); !settled) {
        return failed(disk_failure(packs_folder_name, settled.error()));
    }
    may_clear_away_ = true;
    clear_away_if_sure();
    return {};
}

ImportResult<void> SetOnDisk::rewrite(SetFile next) {
    may_clear_away_ = false;
    if (const FileResult<void> switched = switch_to(library_, next); !switched) {
        return failed(disk_failure(set_file_name, switched.error()));
    }
    known_ = std::move(next);
    may_clear_away_ = true;
    clear_away_if_sure();
    return {};
}

ImportResult<void> SetOnDisk::forget_older_sets() {
    SetFile next = known_;
    next.choice.last_good.reset();
    next.before.reset();
    return next == known_ || !is_judged(known_, verdict_, TrialState::Good) ? ImportResult<void>()
                                                                            : rewrite(std::move(next));
}

ImportResult<void> SetOnDisk::switch_set(SetFile next) {
    if (next == known_) {
        return {};
    }
    may_clear_away_ = false; // until it is certain which of the two is on the disk
    if (const FileResult<void> switched = switch_to(library_, next); !switched) {
        const ImportResult<SetFile> now = read_set_file(library_);
        is_unsure_ = now && *now == next;
        if (!is_unsure_) {
            return failed(disk_failure(set_file_name, switched.error()));
        }
    }
    known_ = std::move(next);
    may_clear_away_ = !is_unsure_;
    return {};
}

void SetOnDisk::clear_away_if_sure() {
    if (may_clear_away_) {
        clear_away(library_, known_);
    }
}

} // namespace frustumscreen::library
