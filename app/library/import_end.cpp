#include "app/library/import_end.h"

#include <utility>

namespace frustumscreen {

namespace {

bool is_last(ImportStage stage) {
    return stage == ImportStage::Done || stage == ImportStage::Failed;
}

} // namespace

std::optional<ImportReport> last_word(const std::optional<ImportReport>& last, std::string import_id,
                                      std::string_view service_result, std::uint64_t set_number) {
    const bool is_ours = last && last->import_id == import_id;
    if (last && (is_ours ? is_last(last->stage) : !is_last(last->stage))) {
        return std::nullopt;
    }
    ImportReport report = is_ours ? *last : ImportReport{};
    if (report.stage == ImportStage::MayTakeOut) { // what was left to do nobody needs to hear of
        report.stage = ImportStage::Done;
        return report;
    }
    report.import_id = std::move(import_id);
    if (last && !is_ours && service_result == "success") {
        return std::nullopt;
    }
    report.stage = ImportStage::Failed;
    report.set_number = set_number;
    report.refusal = ImportRefusal::Unreadable;
    report.reason = "the import was stopped before its end; put the stick in again";
    if (service_result == "timeout" || service_result == "oom-kill" || service_result == "resources") {
        report.refusal = ImportRefusal::TooMuch;
        report.reason =
            "the stick takes more time or memory than it may; put fewer files on it, or try another one";
    }
    for (ImportedPack& pack : report.packs) { // none was switched to
        if (pack.outcome == ImportOutcome::Pending || pack.outcome == ImportOutcome::Taken) {
            pack.outcome = ImportOutcome::Refused;
            pack.refusal = report.refusal;
            pack.reason = "nothing of this stick was taken: " + report.reason;
        }
    }
    return report;
}

} // namespace frustumscreen
