#include "app/library/import_stick.h"

#include "app/library/copy_pack.h"
#include "app/library/copy_stage.h"
#include "app/library/library_folder.h"
#include "app/library/next_set_file.h"
#include "app/library/pack_signers.h"
#include "app/library/set_plan.h"
#include "app/library/signed_exhibit_file.h"
#include "app/library/stick_walk.h"
#include "app/library/trusted_keys.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace frustumscreen {

namespace {

constexpr Nanoseconds between_reports = std::chrono::milliseconds(100); ///< during a copy

using Outcome = tl::expected<void, ImportFailure>;

tl::unexpected<ImportFailure> failed(ImportFailure failure) {
    return tl::unexpected<ImportFailure>(std::move(failure));
}

class Import {
public:
    Import(FileTree& stick, WritableTree& library, const ImportRequest& request,
           const ImportEnvironment& outside)
        : stick_(stick), library_(library), request_(request), outside_(outside), in_vain_(request.limits) {
        report_.import_id = request.import_id;
        report_.stick = printable(request.stick);
    }

    /// Nothing if the exhibit has changed to another set than the one that the packs were weighed against: the
    /// import starts again.
    std::optional<ImportReport> run();

private:
    Outcome all();
    Outcome read_library();
    Outcome remember_day();
    Outcome look();
    Outcome read_exhibit_file(bool is_there);
    Outcome look_at_packs(const std::vector<std::string>& paths);
    void weigh();
    Outcome plan();
    Outcome look_for_room();
    Outcome forget_older_sets();
    Outcome rewrite(SetFile next);
    Outcome copy();
    Outcome read_verdict_again();
    [[nodiscard]] std::string of_ended_keys(const InstalledSet& set);
    Outcome switch_set();
    void progress(std::uint64_t bytes);
    [[nodiscard]] bool is_too_late() const { return outside_.now() - began_ > request_.limits.look; }
    [[nodiscard]] std::optional<std::chrono::sys_days> today() const {
        return day_here(request_.today, known_.latest_day);
    }
    [[nodiscard]] PackTrust trust() const { return {keys_, today(), request_.unsigned_packs}; }
    [[nodiscard]] const InstalledSet& shown() const { return set_to_show(known_.choice, verdict_); }
    void tell(ImportStage stage);
    void fail_whole(const ImportFailure& failure);

    FileTree& stick_;
    WritableTree& library_;
    const ImportRequest& request_;
    const ImportEnvironment& outside_;
    MonotonicTime began_{}; ///< start of the look at the stick; the kiosk's own disk does not count
    ImportReport report_;
    std::vector<ImportedPack> refused_on_the_way_; ///< of which only the name is known
    std::optional<ImportedPack> misnamed_;         ///< a file that may be meant as set file
    std::optional<ImportedPack> misnamed_settings_;
    std::optional<ImportedPack> misnamed_request_;
    std::vector<ImportedPack> misnamed_copy_;
    std::vector<StickPack> packs_;
    std::vector<InstalledPack> removed_;
    std::optional<ImportedPack> exhibit_line_;
    std::optional<SignedExhibitFile> exhibit_;
    std::vector<TrustedKey> keys_;
    std::vector<CarriedKey> carried_; ///< including those that the set file brings
    SetFile known_;
    bool may_clear_away_ = false; ///< known_ is on the disk
    bool is_unsure_ = false;      ///< known_ is shown, but may not be on the disk
    std::optional<SetVerdict> verdict_;
    bool shows_another_ = false; ///< than at the first look
    WastedWorkBudget in_vain_;
    MonotonicTime told_{};
};

void Import::tell(ImportStage stage) {
    report_.stage = stage;
    told_ = outside_.now();
    report_.packs.clear();
    if (request_.settings) {
        report_.packs.push_back(*request_.settings);
    }
    for (const auto* lines : {&request_.kiosk, &request_.stick_report}) {
        report_.packs.insert(report_.packs.end(), lines->begin(), lines->end());
    }
    if (exhibit_line_) {
        report_.packs.push_back(*exhibit_line_);
    }
    for (const StickPack& pack : packs_) {
        report_.packs.push_back(pack.told);
    }
    report_.packs.insert(report_.packs.end(), refused_on_the_way_.begin(), refused_on_the_way_.end());
    if (misnamed_) {
        report_.packs.push_back(*misnamed_);
    }
    if (misnamed_settings_ && request_.takes_settings && !request_.settings) {
        report_.packs.push_back(*misnamed_settings_);
    }
    if (misnamed_request_ && request_.writes_reports && request_.stick_report.empty()) {
        report_.packs.push_back(*misnamed_request_);
    }
    if (request_.takes_settings) {
        report_.packs.insert(report_.packs.end(), misnamed_copy_.begin(), misnamed_copy_.end());
    }
    for (const InstalledPack& pack : removed_) {
        report_.packs.push_back(removed_line(pack));
    }
    outside_.tell(report_);
}

void Import::fail_whole(const ImportFailure& failure) {
    report_.refusal = failure.refusal;
    report_.reason = failure.reason;
    if (!is_unsure_) { // nothing was taken, and every line says so
        removed_.clear();
        const bool is_by_exhibit_file =
            exhibit_line_ && (exhibit_line_->outcome == ImportOutcome::Refused || failure.by_set_file);
        std::string of_each =
            "nothing of this stick was taken" +
            (is_by_exhibit_file ? fmt::format(", because of {}", exhibit_file_name) : ": " + failure.reason);
        if (exhibit_line_ && exhibit_line_->outcome != ImportOutcome::Refused) {
            refuse(*exhibit_line_,
                   is_by_exhibit_file ? failure : ImportFailure{failure.refusal, of_each, false});
        }
        refuse_all(packs_, {failure.refusal, std::move(of_each), false});
    }
    tell(ImportStage::Failed);
}

Outcome Import::read_library() {
    TRY(known_, read_set_file(library_));
    TRY(verdict_, read_verdict(library_));
    report_.set_number = known_.choice.set.number;
    if (const FileResult<void> settled = settle(library_); !settled) {
        return failed(disk_failure(packs_folder_name, settled.error()));
    }
    may_clear_away_ = true;
    clear_away(library_, known_);
    carried_ = known_.keys;
    keys_ = trusted_keys(request_.keys, carried_);
    return remember_day();
}

/// Comes before the look at the stick, so that a refused stick counts too. If no key has a last day, the day does
/// not matter.
Outcome Import::remember_day() {
    SetFile next = known_;
    next.latest_day = latest_day(known_.latest_day, request_.today);
    const bool ends =
        std::any_of(keys_.begin(), keys_.end(), [](const TrustedKey& key) { return key.until.has_value(); });
    return ends && !(next == known_) ? rewrite(std::move(next)) : Outcome();
}

Outcome Import::read_exhibit_file(bool is_there) {
    if (!is_there) {
        return {};
    }
    exhibit_line_.emplace().file = exhibit_file_name;
    tl::expected<SignedExhibitFile, ImportFailure> read = read_signed_exhibit_file(stick_, trust(), known_);
    if (read && read->signer) {
        Result<std::vector<CarriedKey>> carried =
            with_brought_keys(carried_, read->file.keys, *read->signer, request_.keys, today());
        if (carried) {
            carried_ = *std::move(carried);
            keys_ = trusted_keys(request_.keys, carried_);
        } else {
            read = failed({ImportRefusal::WrongKey,
                           fmt::format("{}: {}", exhibit_file_name, carried.error().message), true});
        }
    }
    if (!read) {
        refuse(*exhibit_line_, read.error());
        return failed(read.error());
    }
    exhibit_ = *std::move(read);
    return {};
}

Outcome Import::look_at_packs(const std::vector<std::string>& paths) {
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
        in_vain_.add_look(outside_.work() - before);
        if (in_vain_.is_too_much()) {
            return failed(too_much(
                "the stick holds many files that look like packs and are not packs; put only packs on it"));
        }
    }
    return {};
}

Outcome Import::look() {
    began_ = outside_.now();
    tell(ImportStage::Found);
    TRY(StickFiles files, walk_stick(stick_, request_.limits, [this] { return is_too_late(); }));
    refused_on_the_way_ = std::move(files.refused);
    misnamed_ = std::move(files.misnamed);
    misnamed_settings_ = std::move(files.misnamed_settings);
    misnamed_request_ = std::move(files.misnamed_request);
    misnamed_copy_ = std::move(files.misnamed_copy);
    return read_exhibit_file(files.has_exhibit_file).and_then([&] { return look_at_packs(files.packs); });
}

/// Reads each installed file once, however often the stick has its pack.
void Import::weigh() {
    std::map<std::string, bool> sound;
    weigh_packs(packs_, shown(), known_, [&](const InstalledPack& pack) {
        const auto [file, is_new] = sound.try_emplace(pack.file);
        if (is_new) {
            file->second = is_sound(library_, pack, request_.limits.step_bytes);
        }
        return file->second;
    });
}

/// Checks the set file against the packs before anything is copied; switch_set plans again afterwards.
Outcome Import::plan() {
    return without_value(plan_set(shown(), packs_, refused_on_the_way_,
                                  exhibit_ ? std::optional(exhibit_->file) : std::nullopt));
}

Outcome Import::look_for_room() {
    std::uint64_t wanted = 0;
    for (const StickPack& pack : packs_) {
        wanted += pack.is_wanted() ? pack.pack.bytes : 0;
    }
    report_.total_bytes = 2 * wanted; // each byte is copied and checked
    if (wanted == 0) {
        return {};
    }
    const std::uint64_t needed = wanted + request_.limits.margin_bytes;
    FileResult<std::uint64_t> free = library_.free_bytes();
    if (free && *free < needed) {
        TRY_VOID(forget_older_sets());
        free = library_.free_bytes();
    }
    if (!free) {
        return failed(disk_failure(packs_folder_name, free.error()));
    }
    return *free < needed ? failed(no_room(wanted, *free, request_.limits.margin_bytes)) : Outcome();
}

/// If the current set is good, no older set is needed, and the files of older packs may go.
Outcome Import::forget_older_sets() {
    SetFile next = known_;
    next.choice.last_good.reset();
    next.before.reset();
    return next == known_ || !is_judged(known_, verdict_, TrialState::Good) ? Outcome()
                                                                            : rewrite(std::move(next));
}

Outcome Import::rewrite(SetFile next) {
    may_clear_away_ = false;
    if (const FileResult<void> switched = switch_to(library_, next); !switched) {
        return failed(disk_failure(set_file_name, switched.error()));
    }
    known_ = std::move(next);
    may_clear_away_ = true;
    clear_away(library_, known_);
    return {};
}

/// A report has a line for each pack, so it is not written at each step.
void Import::progress(std::uint64_t bytes) {
    report_.done_bytes = std::min(bytes, report_.total_bytes);
    if (outside_.now() - told_ >= between_reports) {
        tell(ImportStage::Copying);
    }
}

Outcome Import::copy() {
    if (report_.total_bytes > 0) {
        tell(ImportStage::Copying);
    }
    CopyStage stage(stick_, library_, request_.limits, outside_, in_vain_,
                    [this](std::uint64_t bytes) { progress(bytes); });
    return stage.run(packs_, trust());
}

/// Copying takes minutes, in which the exhibit may reach a verdict.
Outcome Import::read_verdict_again() {
    const std::uint64_t weighed = shown().number;
    TRY(verdict_, read_verdict(library_));
    shows_another_ = shown().number != weighed;
    return {};
}

/// A museum that withdraws a key reads which packs still carry its signature.
std::string Import::of_ended_keys(const InstalledSet& set) {
    if (!exhibit_ || exhibit_->file.keys.empty()) {
        return {};
    }
    const std::vector<std::string> packs = packs_of_ended_keys(library_, set, keys_, today());
    return packs.empty() ? std::string()
                         : fmt::format("packs of a key that is no longer trusted stay: {}; take them out "
                                       "with remove, or sign them with another key",
                                       names_in_words(packs));
}

/// Serials and keys are kept even if the set stays as it is.
Outcome Import::switch_set() {
    TRY(PlannedSet planned, plan_set(shown(), packs_, refused_on_the_way_,
                                     exhibit_ ? std::optional(exhibit_->file) : std::nullopt));
    SetFile next = known_;
    remember(next, packs_, exhibit_);
    next.keys = carried_;
    if (next.serials.size() > max_accepted_serials || next.keys.size() > max_carried_keys) {
        return failed(
            too_much("the kiosk has taken as many different packs and keys as it can remember; call "
                     "a technician"));
    }
    // The exhibit opens a mended file only with another set.
    const bool has_mended = std::any_of(packs_.begin(), packs_.end(), [](const StickPack& pack) {
        return pack.mends && pack.told.outcome == ImportOutcome::Taken;
    });
    if (!(planned.set == shown()) || has_mended) {
        replace_set(next, std::move(planned.set), verdict_);
    }
    if (!(next == known_)) {
        may_clear_away_ = false; // until it is certain which of the two is on the disk
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
        exhibit_line_->reason = of_ended_keys(next.choice.set);
    }
    known_ = std::move(next);
    may_clear_away_ = !is_unsure_;
    removed_ = std::move(planned.removed);
    report_.set_number = known_.choice.set.number;
    return is_unsure_ ? failed(unsure_switch()) : Outcome();
}

Outcome Import::all() {
    return read_library()
        .and_then([this] { return look(); })
        .and_then([this] {
            weigh();
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
                          const ImportEnvironment& environment) {
    std::optional<ImportReport> report;
    while (!report) { // a verdict only goes on, from trying to good or bad: this ends soon
        report = Import(stick, library, request, environment).run();
    }
    return *std::move(report);
}

} // namespace frustumscreen
