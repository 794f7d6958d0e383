#include "app/library/import_stick.h"

#include "app/library/copy_pack.h"
#include "app/library/library_folder.h"
#include "app/library/set_plan.h"
#include "app/library/signed_exhibit_file.h"
#include "app/library/stick_walk.h"
#include "firmware_host/base/printable.h"

#include <algorithm>
#include <utility>

namespace frustumscreen {

namespace {

using Outcome = tl::expected<void, ImportFailure>;

tl::unexpected<ImportFailure> failed(ImportFailure failure) {
    return tl::unexpected<ImportFailure>(std::move(failure));
}

class Import {
public:
    Import(FileTree& stick, WritableTree& library, const ImportRequest& request,
           const ImportSurroundings& outside)
        : stick_(stick), library_(library), request_(request), outside_(outside), began_(outside.now()) {
        report_.import_id = request.import_id;
        report_.stick = printable(request.stick);
    }

    /// Nothing: the exhibit shows another set by now than the one that all was weighed against; it is to be begun anew.
    std::optional<ImportReport> run();

private:
    Outcome all();
    Outcome read_library();
    Outcome look();
    Outcome read_exhibit_file(bool is_there);
    Outcome look_at_packs(const std::vector<std::string>& paths);
    Outcome look_for_room();
    Outcome forget_older_sets();
    Outcome copy();
    Outcome copy_one(StickPack& pack);
    Outcome read_verdict_again();
    Outcome switch_set();
    [[nodiscard]] bool is_judged(Verdict verdict) const {
        return verdict_ && verdict_->number == known_.choice.set.number && verdict_->verdict == verdict;
    }
    /// Higher than any that the exhibit has judged, though set.txt may have been removed.
    [[nodiscard]] std::uint64_t next_number() const {
        return std::max(known_.choice.set.number, verdict_ ? verdict_->number : 0) + 1;
    }
    [[nodiscard]] std::optional<ImportFailure> progress(std::uint64_t bytes);
    [[nodiscard]] bool is_too_late() const { return outside_.now() - began_ > request_.limits.look; }
    [[nodiscard]] PackTrust trust() const { return {keys_, request_.today, request_.unsigned_packs}; }
    void tell(ImportStage stage);
    void fail_whole(const ImportFailure& failure);
    void refuse_all(const ImportFailure& failure);

    FileTree& stick_;
    WritableTree& library_;
    const ImportRequest& request_;
    const ImportSurroundings& outside_;
    MonotonicTime began_;
    ImportReport report_;
    std::vector<ImportedPack> refused_on_the_way_; ///< of which nothing is known but the name
    std::vector<StickPack> packs_;
    std::vector<InstalledPack> removed_;
    std::optional<ImportedPack> exhibit_line_;
    std::optional<SignedExhibitFile> exhibit_;
    std::vector<TrustedKey> keys_;
    SetFile known_;
    bool may_clear_away_ = false; ///< known_ is on the disk
    bool is_unsure_ = false;      ///< known_ is shown, and may not be on the disk
    std::optional<SetVerdict> verdict_;
    bool shows_another_ = false; ///< since the first look
    MonotonicTime pace_began_{};
    std::uint64_t pace_bytes_ = 0;
};

void Import::tell(ImportStage stage) {
    report_.stage = stage;
    report_.packs.clear();
    if (exhibit_line_) {
        report_.packs.push_back(*exhibit_line_);
    }
    for (const StickPack& pack : packs_) {
        report_.packs.push_back(pack.told);
    }
    report_.packs.insert(report_.packs.end(), refused_on_the_way_.begin(), refused_on_the_way_.end());
    for (const InstalledPack& pack : removed_) {
        report_.packs.push_back(removed_line(pack));
    }
    outside_.tell(report_);
}

void Import::fail_whole(const ImportFailure& failure) {
    report_.refusal = failure.refusal;
    report_.reason = failure.reason;
    if (!is_unsure_) {
        refuse_all(failure);
    }
    tell(ImportStage::Failed);
}

/// Nothing is taken, and every line says so.
void Import::refuse_all(const ImportFailure& failure) {
    removed_.clear();
    const ImportFailure of_each{failure.refusal, "nothing of this stick was taken: " + failure.reason, false};
    for (StickPack& pack : packs_) {
        if (pack.is_wanted()) {
            refuse(pack.told, of_each);
        }
    }
    if (exhibit_line_ && exhibit_line_->outcome != ImportOutcome::Refused) {
        refuse(*exhibit_line_, of_each);
    }
}

Outcome Import::read_library() {
    tl::expected<SetFile, ImportFailure> known = read_set_file(library_);
    if (!known) {
        return failed(known.error());
    }
    known_ = *std::move(known);
    const tl::expected<std::optional<SetVerdict>, ImportFailure> verdict = read_verdict(library_);
    if (!verdict) {
        return failed(verdict.error());
    }
    verdict_ = *verdict;
    report_.set_number = known_.choice.set.number;
    if (const FileResult<void> settled = settle(library_); !settled) {
        return failed(disk_failure(packs_folder_name, settled.error()));
    }
    may_clear_away_ = true;
    clear_away(library_, known_);
    keys_ = request_.keys;
    add_carried_keys(known_.keys, keys_);
    return {};
}

Outcome Import::read_exhibit_file(bool is_there) {
    if (!is_there) {
        return {};
    }
    exhibit_line_.emplace().file = exhibit_file_name;
    tl::expected<SignedExhibitFile, ImportFailure> read =
        read_signed_exhibit_file(stick_, trust(), known_.exhibit_serial);
    if (!read) {
        refuse(*exhibit_line_, read.error());
        return failed(read.error());
    }
    exhibit_ = *std::move(read);
    add_carried_keys(exhibit_->file.keys, keys_);
    return {};
}

Outcome Import::look_at_packs(const std::vector<std::string>& paths) {
    Nanoseconds in_vain{0};
    for (const std::string& path : paths) {
        const Nanoseconds before = outside_.work();
        tl::expected<StickPack, ImportFailure> pack = look_at_pack(stick_, path, trust());
        if (is_too_late()) {
            return failed(too_slow());
        }
        if (pack) {
            packs_.push_back(*std::move(pack));
            continue;
        }
        StickPack& refused = packs_.emplace_back();
        refused.path = path;
        refused.told.file = printable(path);
        if (pack.error().whole) {
            return failed(pack.error());
        }
        refuse(refused.told, pack.error());
        in_vain += outside_.work() - before;
        if (in_vain > request_.limits.refused_work) {
            return failed(too_much("the stick holds many files that look like packs and are none; put only "
                                   "packs on it"));
        }
    }
    return {};
}

Outcome Import::look() {
    tell(ImportStage::Found);
    tl::expected<StickFiles, ImportFailure> files =
        walk_stick(stick_, request_.limits, [this] { return is_too_late(); });
    if (!files) {
        return failed(files.error());
    }
    refused_on_the_way_ = std::move(files->refused);
    return read_exhibit_file(files->has_exhibit_file).and_then([&] { return look_at_packs(files->packs); });
}

Outcome Import::look_for_room() {
    std::uint64_t wanted = 0;
    for (const StickPack& pack : packs_) {
        wanted += pack.is_wanted() ? pack.pack.bytes : 0;
    }
    report_.total_bytes = 2 * wanted; // each byte is copied, and checked
    if (wanted == 0) {
        return {};
    }
    const std::uint64_t needed = wanted + request_.limits.margin_bytes;
    FileResult<std::uint64_t> free = library_.free_bytes();
    if (free && *free < needed) {
        if (Outcome forgotten = forget_older_sets(); !forgotten) {
            return forgotten;
        }
        free = library_.free_bytes();
    }
    if (!free) {
        return failed(disk_failure(packs_folder_name, free.error()));
    }
    return *free < needed ? failed(no_room(wanted, *free, request_.limits.margin_bytes)) : Outcome();
}

/// Where the set is good, nothing older is needed. Their packs need not be there for nothing.
Outcome Import::forget_older_sets() {
    SetFile next = known_;
    next.choice.last_good.reset();
    next.before.reset();
    if (next == known_ || !is_judged(Verdict::Good)) {
        return {};
    }
    may_clear_away_ = false;
    if (const FileResult<void> switched = switch_to(library_, next); !switched) {
        return failed(disk_failure(set_file_name, switched.error()));
    }
    known_ = std::move(next);
    may_clear_away_ = true;
    clear_away(library_, known_);
    return {};
}

std::optional<ImportFailure> Import::progress(std::uint64_t bytes) {
    report_.done_bytes = std::min(report_.done_bytes + bytes, report_.total_bytes);
    pace_bytes_ += bytes;
    const MonotonicTime now = outside_.now();
    if (now - pace_began_ > request_.limits.pace) {
        if (pace_bytes_ < request_.limits.pace_bytes) {
            return too_slow();
        }
        pace_began_ = now;
        pace_bytes_ = 0;
    }
    tell(ImportStage::Copying);
    return std::nullopt;
}

Outcome Import::copy() {
    pace_began_ = outside_.now();
    if (report_.total_bytes > 0) {
        tell(ImportStage::Copying);
    }
    std::uint64_t done = 0; // with the packs that are decided on, however far they came
    for (const std::size_t k : copy_order(packs_)) {
        StickPack& pack = packs_[k];
        if (!pack.is_wanted()) {
            continue;
        }
        done += 2 * pack.pack.bytes;
        weigh_against_taken(pack, packs_);
        if (pack.is_wanted()) {
            const Outcome copied = copy_one(pack);
            if (!copied) {
                return copied;
            }
        }
        report_.done_bytes = done;
    }
    const FileResult<void> synced =
        done > 0 ? library_.sync_folder(std::string(packs_folder_name)) : FileResult<void>();
    return synced ? Outcome() : failed(disk_failure(packs_folder_name, synced.error()));
}

Outcome Import::copy_one(StickPack& pack) {
    const tl::expected<InstalledPack, ImportFailure> copied =
        copy_pack(stick_, library_, pack, trust(), request_.limits.step_bytes,
                  [this](std::uint64_t bytes) { return progress(bytes); });
    if (copied) {
        pack.pack = *copied;
        pack.told.outcome = ImportOutcome::Taken;
    } else if (copied.error().whole) {
        return failed(copied.error());
    } else {
        refuse(pack.told, copied.error());
    }
    return {};
}

/// Copying takes minutes, in which the exhibit may have come to a verdict.
Outcome Import::read_verdict_again() {
    const std::uint64_t weighed = set_to_show(known_.choice, verdict_).number;
    const tl::expected<std::optional<SetVerdict>, ImportFailure> verdict = read_verdict(library_);
    if (!verdict) {
        return failed(verdict.error());
    }
    verdict_ = *verdict;
    shows_another_ = set_to_show(known_.choice, verdict_).number != weighed;
    return {};
}

/// Serials and keys are kept even where the set stays as it is.
Outcome Import::switch_set() {
    const InstalledSet& shown = set_to_show(known_.choice, verdict_);
    tl::expected<PlannedSet, ImportFailure> planned =
        plan_set(shown, packs_, exhibit_ ? std::optional(exhibit_->file) : std::nullopt);
    if (!planned) {
        return failed(planned.error());
    }
    SetFile next = known_;
    remember(next, packs_, exhibit_);
    if (next.serials.size() > most_accepted_serials || next.keys.size() > most_carried_keys) {
        return failed(
            too_much("the kiosk has taken as many different packs and keys as it can remember; call "
                     "a technician"));
    }
    if (!(planned->set == shown)) {
        next.choice.last_good = set_to_go_back_to(known_.choice, verdict_);
        next.before =
            is_judged(Verdict::Bad) ? shown : known_.choice.set; // on its last trial it is shown now
        next.choice.set = std::move(planned->set);
        next.choice.set.number = next_number();
    }
    if (!(next == known_)) {
        may_clear_away_ = false; // as long as nobody knows which of the two is on the disk
        if (const FileResult<void> switched = switch_to(library_, next); !switched) {
            const tl::expected<SetFile, ImportFailure> now = read_set_file(library_);
            is_unsure_ = now && *now == next;
            if (!is_unsure_) {
                return failed(disk_failure(set_file_name, switched.error()));
            }
        }
    }
    if (exhibit_line_) {
        exhibit_line_->outcome = next == known_ ? ImportOutcome::AlreadyThere : ImportOutcome::Taken;
    }
    known_ = std::move(next);
    may_clear_away_ = !is_unsure_;
    removed_ = std::move(planned->removed);
    report_.set_number = known_.choice.set.number;
    return is_unsure_ ? failed(unsure_switch()) : Outcome();
}

Outcome Import::all() {
    // Whether the set file allows the set at all is known before anything is copied, and again after.
    const auto plan = [this]() -> Outcome {
        const auto planned = plan_set(set_to_show(known_.choice, verdict_), packs_,
                                      exhibit_ ? std::optional(exhibit_->file) : std::nullopt);
        return planned ? Outcome() : failed(planned.error());
    };
    return read_library()
        .and_then([this] { return look(); })
        .and_then([&]() -> Outcome {
            weigh_packs(packs_, set_to_show(known_.choice, verdict_), known_);
            return plan();
        })
        .and_then([this] { return look_for_room(); })
        .and_then([this] { return copy(); })
        .and_then([this] { return read_verdict_again(); })
        .and_then([this] { return shows_another_ ? Outcome() : switch_set(); });
}

std::optional<ImportReport> Import::run() {
    const Outcome outcome = all();
    if (shows_another_) {
        return std::nullopt;
    }
    if (outcome) {
        report_.done_bytes = report_.total_bytes;
        tell(ImportStage::MayTakeOut);
    }
    if (may_clear_away_) {
        clear_away(library_, known_);
    }
    if (outcome) {
        tell(ImportStage::Done);
    } else {
        fail_whole(outcome.error());
    }
    return report_;
}

} // namespace

ImportReport import_stick(FileTree& stick, WritableTree& library, const ImportRequest& request,
                          const ImportSurroundings& surroundings) {
    std::optional<ImportReport> report;
    while (!report) { // a verdict only goes on, from trying to good or bad: this ends soon
        report = Import(stick, library, request, surroundings).run();
    }
    return *std::move(report);
}

} // namespace frustumscreen
