#include "app/library/import_stick.h"

#include "app/library/copy_stage.h"
#include "app/library/import_reporter.h"
#include "app/library/kiosk_keys.h"
#include "app/library/library_folder.h"
#include "app/library/next_set_file.h"
#include "app/library/pack_signers.h"
#include "app/library/set_on_disk.h"
#include "app/library/set_plan.h"
#include "app/library/stick_look.h"
#include "app/library/trusted_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace frustumscreen::library {

namespace {

/// The steps of an import, in their order.
class Import {
public:
    Import(FileTree& stick, WritableTree& library, const ImportRequest& request,
           const ImportEnvironment& outside)
        : stick_(stick), library_(library), request_(request), outside_(outside), set_(library),
          keys_(request), in_vain_(request.limits), reporter_(request, outside, contents_) {}

    /// Nothing if the exhibit has changed to another set than the one that the packs were weighed against: the
    /// import starts again.
    std::optional<ImportReport> run();

private:
    ImportResult<void> all();
    ImportResult<void> read_library();
    ImportResult<void> remember_day();
    ImportResult<void> look();
    void weigh();
    [[nodiscard]] ImportResult<PlannedSet> plan() const;
    ImportResult<void> check_space();
    ImportResult<void> copy();
    ImportResult<void> read_verdict_again();
    ImportResult<void> switch_set();
    [[nodiscard]] ImportResult<SetFile> next_set_file(InstalledSet planned) const;
    [[nodiscard]] std::string of_ended_keys(const InstalledSet& set);
    void fail_whole(const ImportFailure& failure);

    FileTree& stick_;
    WritableTree& library_;
    const ImportRequest& request_;
    const ImportEnvironment& outside_;
    StickContents contents_;
    SetOnDisk set_;
    KioskKeys keys_;
    WastedWorkBudget in_vain_;
    ImportReporter reporter_;
    bool shows_another_ = false; ///< than at the first look
};

ImportResult<void> Import::read_library() {
    TRY_VOID(set_.read());
    reporter_.set_number(set_.known().choice.set.number);
    TRY_VOID(set_.settle());
    keys_.read(set_.known());
    return remember_day();
}

/// Comes before the look at the stick, so that a refused stick counts too. If no key has a last day, the day does
/// not matter.
ImportResult<void> Import::remember_day() {
    SetFile next = set_.known();
    next.latest_day = latest_day(next.latest_day, request_.today);
    if (keys_.some_end() && !(next == set_.known())) {
        TRY_VOID(set_.rewrite(std::move(next)));
        keys_.read(set_.known());
    }
    return {};
}

ImportResult<void> Import::look() {
    StickLook look(stick_, request_.limits, outside_, keys_, in_vain_);
    reporter_.tell(ImportStage::Found);
    return look.run(contents_, set_.known());
}

/// Reads each installed file once, however often the stick has its pack.
void Import::weigh() {
    std::map<std::string, bool> sound;
    weigh_packs(contents_.packs, set_.shown(), set_.known(), [&](const InstalledPack& pack) {
        const auto [file, is_new] = sound.try_emplace(pack.file);
        if (is_new) {
            file->second = is_sound(library_, pack, request_.limits.step_bytes);
        }
        return file->second;
    });
}

/// Made twice: before anything is copied, which checks the set file against the packs, and from what was copied.
ImportResult<PlannedSet> Import::plan() const {
    return plan_set(set_.shown(), contents_.packs, contents_.files.refused,
                    contents_.exhibit ? std::optional(contents_.exhibit->file) : std::nullopt);
}

ImportResult<void> Import::check_space() {
    std::uint64_t wanted = 0;
    for (const StickPack& pack : contents_.packs) {
        wanted += pack.is_wanted() ? pack.pack.bytes : 0;
    }
    reporter_.set_total_bytes(2 * wanted); // each byte is copied and checked
    if (wanted == 0) {
        return {};
    }
    const std::uint64_t needed = wanted + request_.limits.margin_bytes;
    FileResult<std::uint64_t> free = library_.free_bytes();
    if (free && *free < needed) {
        TRY_VOID(set_.forget_older_sets());
        free = library_.free_bytes();
    }
    if (!free) {
        return failed(disk_failure(packs_folder_name, free.error()));
    }
    return *free < needed ? failed(no_space(wanted, *free, request_.limits.margin_bytes))
                          : ImportResult<void>();
}

ImportResult<void> Import::copy() {
    if (reporter_.report().total_bytes > 0) {
        reporter_.tell(ImportStage::Copying);
    }
    CopyStage stage(stick_, library_, request_.limits, outside_, in_vain_,
                    [this](std::uint64_t bytes) { reporter_.progress(bytes); });
    return stage.run(contents_.packs, keys_.trust());
}

/// Copying takes minutes, in which the exhibit may reach a verdict.
ImportResult<void> Import::read_verdict_again() {
    const std::uint64_t weighed = set_.shown().number;
    TRY_VOID(set_.read_verdict_again());
    shows_another_ = set_.shown().number != weighed;
    return {};
}

/// A museum that withdraws a key reads which packs still carry its signature.
std::string Import::of_ended_keys(const InstalledSet& set) {
    if (!contents_.exhibit || contents_.exhibit->file.keys.empty()) {
        return {};
    }
    const pack::PackTrust trust = keys_.trust();
    const std::vector<std::string> packs = packs_of_ended_keys(library_, set, trust.keys, trust.today);
    return packs.empty() ? std::string()
                         : fmt::format("packs of a key that is no longer trusted stay: {}; take them out "
                                       "with remove, or sign them with another key",
                                       names_in_words(packs));
}

/// Serials and keys are kept even if the set stays as it is.
ImportResult<SetFile> Import::next_set_file(InstalledSet planned) const {
    SetFile next = set_.known();
    remember(next, contents_.packs, contents_.exhibit);
    next.keys = keys_.carried();
    if (next.serials.size() > max_accepted_serials || next.keys.size() > max_carried_keys) {
        return failed(
            too_much("the kiosk has taken as many different packs and keys as it can remember; call "
                     "a technician"));
    }
    // The exhibit opens a mended file only with another set.
    const bool has_mended =
        std::any_of(contents_.packs.begin(), contents_.packs.end(), [](const StickPack& pack) {
            return pack.mends && pack.told.outcome == ImportOutcome::Taken;
        });
    if (!(planned == set_.shown()) || has_mended) {
        replace_set(next, std::move(planned), set_.verdict());
    }
    return next;
}

ImportResult<void> Import::switch_set() {
    TRY(PlannedSet planned, plan());
    TRY(SetFile next, next_set_file(std::move(planned.set)));
    const bool is_same = next == set_.known();
    TRY_VOID(set_.switch_set(std::move(next)));
    const InstalledSet& installed = set_.known().choice.set;
    if (contents_.exhibit_line) {
        contents_.exhibit_line->outcome = is_same ? ImportOutcome::AlreadyThere : ImportOutcome::Taken;
        contents_.exhibit_line->reason = of_ended_keys(installed);
    }
    reporter_.set_removed(std::move(planned.removed));
    reporter_.set_number(installed.number);
    return set_.is_unsure() ? failed(unsure_switch()) : ImportResult<void>();
}

ImportResult<void> Import::all() {
    return read_library()
        .and_then([this] { return look(); })
        .and_then([this] {
            weigh();
            return without_value(plan());
        })
        .and_then([this] { return check_space(); })
        .and_then([this] { return copy(); })
        .and_then([this] { return read_verdict_again(); })
        .and_then([this] { return shows_another_ ? ImportResult<void>() : switch_set(); });
}

void Import::fail_whole(const ImportFailure& failure) {
    if (!set_.is_unsure()) { // nothing was taken, and every line says so
        reporter_.set_removed({});
        refuse_whole(contents_, failure);
    }
    reporter_.tell_failed(failure);
}

std::optional<ImportReport> Import::run() {
    const ImportResult<void> outcome = all();
    if (shows_another_) {
        return std::nullopt;
    }
    if (outcome) {
        reporter_.set_all_done();
        reporter_.tell(ImportStage::MayTakeOut);
    }
    set_.clear_away_if_sure();
    if (outcome) {
        reporter_.tell(ImportStage::Done);
    } else {
        fail_whole(outcome.error());
    }
    return reporter_.report();
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

} // namespace frustumscreen::library
