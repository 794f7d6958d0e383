#include "app/show/import_journal.h"

#include "firmware_host/base/format_sentence.h"

#include <algorithm>

namespace frustumscreen::show {

namespace {

bool is_over(const library::ImportReport& report) {
    return report.stage == library::ImportStage::Done || report.stage == library::ImportStage::Failed;
}

std::size_t count_of(const library::ImportReport& report, library::ImportOutcome outcome) {
    return static_cast<std::size_t>(
        std::count_if(report.packs.begin(), report.packs.end(),
                      [&](const library::ImportedPack& pack) { return pack.outcome == outcome; }));
}

/// The journal goes to the makers: it has no stick's label, which may be a person's name.
Sentence line_of(const library::ImportReport& report) {
    switch (report.stage) {
    case library::ImportStage::Found:
        return format_sentence("stick: a stick is there; its contents are being checked");
    case library::ImportStage::Copying:
        return format_sentence("stick: {} bytes are copied", report.total_bytes);
    case library::ImportStage::MayTakeOut:
        return format_sentence("stick: the stick may be taken out");
    case library::ImportStage::Failed:
        return format_sentence("stick: nothing was taken: {}", report.reason);
    case library::ImportStage::Done:
        break;
    }
    return format_sentence("stick: done: {} taken, {} already there, {} refused, {} removed; the "
                           "installed set has number {}",
                           count_of(report, library::ImportOutcome::Taken),
                           count_of(report, library::ImportOutcome::AlreadyThere),
                           count_of(report, library::ImportOutcome::Refused),
                           count_of(report, library::ImportOutcome::Removed), report.set_number);
}

Sentence line_of(const library::ImportedPack& pack) {
    switch (pack.outcome) {
    case library::ImportOutcome::Taken:
        return format_sentence("stick: {}: taken: {}", pack.file, pack.title);
    case library::ImportOutcome::AlreadyThere:
        return format_sentence("stick: {}: already there: {}", pack.file, pack.title);
    case library::ImportOutcome::Removed:
        return format_sentence("stick: {}: removed: {}", pack.file, pack.title);
    case library::ImportOutcome::Refused:
        return format_sentence("stick: {}: refused: {}", pack.file, pack.reason);
    case library::ImportOutcome::Written:
        return format_sentence("stick: {}: written to the stick", pack.file);
    case library::ImportOutcome::NotWritten:
        return format_sentence("stick: {}: not written to the stick: {}", pack.file, pack.reason);
    case library::ImportOutcome::Pending:
        break;
    }
    return format_sentence("stick: {}: left as it was", pack.file);
}

} // namespace

void ImportJournal::note(const SharedImport& import, const Write& write) {
    if (!import) {
        return;
    }
    const bool goes_on = noted_ && noted_->report.import_id == import->report.import_id;
    if (!goes_on && noted_ && is_over(noted_->report) && packs_ < noted_->report.packs.size()) {
        note_packs(write); // the previous import's packs come first
        return;
    }
    if (noted_ != import) {
        const bool another = !goes_on;
        const bool changed = another || noted_->report.stage != import->report.stage;
        const bool was_over = another && import->is_old && is_over(import->report);
        packs_ = another ? 0 : packs_;
        noted_ = import;
        if (was_over) {
            packs_ = import->report.packs.size();
        } else if (changed) {
            write(import->report.stage == library::ImportStage::Failed ? service::LogPriority::Warning
                                                                       : service::LogPriority::Notice,
                  line_of(import->report));
        }
    }
    note_packs(write);
}

void ImportJournal::note_packs(const Write& write) {
    const std::vector<library::ImportedPack>& packs = noted_->report.packs;
    if (!is_over(noted_->report)) {
        return;
    }
    for (std::size_t lines = 0; lines < max_lines && packs_ < packs.size(); ++lines, ++packs_) {
        const library::ImportedPack& pack = packs[packs_];
        const bool failed = pack.outcome == library::ImportOutcome::Refused ||
                            pack.outcome == library::ImportOutcome::NotWritten;
        write(failed ? service::LogPriority::Warning : service::LogPriority::Notice, line_of(pack));
    }
}

} // namespace frustumscreen::show
