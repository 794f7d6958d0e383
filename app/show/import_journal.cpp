#include "app/show/import_journal.h"

#include "firmware_host/base/format_sentence.h"

#include <algorithm>

namespace frustumscreen {

namespace {

bool is_over(const ImportReport& report) {
    return report.stage == ImportStage::Done || report.stage == ImportStage::Failed;
}

std::size_t count_of(const ImportReport& report, ImportOutcome outcome) {
    return static_cast<std::size_t>(
        std::count_if(report.packs.begin(), report.packs.end(),
                      [&](const ImportedPack& pack) { return pack.outcome == outcome; }));
}

Sentence line_of(const ImportReport& report) {
    switch (report.stage) {
    case ImportStage::Found:
        return format_sentence("stick: one is there, '{}'; it is looked through", report.stick);
    case ImportStage::Copying:
        return format_sentence("stick: {} bytes are copied from '{}'", report.total_bytes, report.stick);
    case ImportStage::MayTakeOut:
        return format_sentence("stick: '{}' may be taken out", report.stick);
    case ImportStage::Failed:
        return format_sentence("stick: nothing was taken from '{}': {}", report.stick, report.reason);
    case ImportStage::Done:
        break;
    }
    return format_sentence("stick: done with '{}': {} taken, {} already there, {} refused, {} removed; the "
                           "installed set has number {}",
                           report.stick, count_of(report, ImportOutcome::Taken),
                           count_of(report, ImportOutcome::AlreadyThere),
                           count_of(report, ImportOutcome::Refused), count_of(report, ImportOutcome::Removed),
                           report.set_number);
}

Sentence line_of(const ImportedPack& pack) {
    switch (pack.outcome) {
    case ImportOutcome::Taken:
        return format_sentence("stick: {}: taken: {}", pack.file, pack.title);
    case ImportOutcome::AlreadyThere:
        return format_sentence("stick: {}: already there: {}", pack.file, pack.title);
    case ImportOutcome::Removed:
        return format_sentence("stick: {}: removed: {}", pack.file, pack.title);
    case ImportOutcome::Refused:
        return format_sentence("stick: {}: refused: {}", pack.file, pack.reason);
    case ImportOutcome::Pending:
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
            write(import->report.stage == ImportStage::Failed ? LogPriority::Warning : LogPriority::Notice,
                  line_of(import->report));
        }
    }
    note_packs(write);
}

void ImportJournal::note_packs(const Write& write) {
    const std::vector<ImportedPack>& packs = noted_->report.packs;
    if (!is_over(noted_->report)) {
        return;
    }
    for (std::size_t lines = 0; lines < max_lines && packs_ < packs.size(); ++lines, ++packs_) {
        const ImportedPack& pack = packs[packs_];
        write(pack.outcome == ImportOutcome::Refused ? LogPriority::Warning : LogPriority::Notice,
              line_of(pack));
    }
}

} // namespace frustumscreen
