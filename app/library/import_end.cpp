#include "app/library/import_end.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::library {

namespace {

bool is_last(ImportStage stage) {
    return stage == ImportStage::Done || stage == ImportStage::Failed;
}

/// The disk of a partition: stick7 for stick7p1.
std::string_view disk_of(std::string_view import_id) {
    return import_id.substr(0, import_id.find('p'));
}

} // namespace

std::optional<ImportReport> final_report_of(const std::optional<ImportReport>& last, std::string import_id,
                                            std::string_view service_result, std::uint64_t set_number) {
    const bool is_ours = last && last->import_id == import_id;
    if (last && (is_ours ? is_last(last->stage) : !is_last(last->stage))) {
        return std::nullopt;
    }
    if (last && !is_ours && service_result == "success") {
        return std::nullopt;
    }
    ImportReport report = is_ours ? *last : ImportReport{};
    if (report.stage == ImportStage::MayTakeOut) { // the remaining work does not concern the staff
        report.stage = ImportStage::Done;
        return report;
    }
    report.import_id = std::move(import_id);
    report.stage = ImportStage::Failed;
    report.set_number = set_number;
    report.refusal = ImportRefusal::Unreadable;
    report.reason = "the import was stopped before its end; put the stick in again";
    if (service_result == "timeout" || service_result == "oom-kill" || service_result == "resources") {
        report.refusal = ImportRefusal::TooMuch;
        report.reason =
            "the stick needs more time or memory than is allowed; put fewer files on it, or try another one";
    }
    for (ImportedPack& pack : report.packs) { // the set was not switched
        if (pack.outcome == ImportOutcome::Pending || pack.outcome == ImportOutcome::Taken) {
            pack.outcome = ImportOutcome::Refused;
            pack.refusal = report.refusal;
            pack.reason = "nothing of this stick was taken: " + report.reason;
        }
    }
    return report;
}

bool must_report_unmounted(const std::optional<ImportReport>& last, std::string_view import_id) {
    if (!last || last->import_id == import_id) {
        return !last;
    }
    return disk_of(last->import_id) != disk_of(import_id) || last->stage == ImportStage::Failed;
}

Nanoseconds delay_before_first_report(const std::optional<ImportReport>& last, std::string_view import_id,
                                      Nanoseconds age, Nanoseconds stands) {
    if (!last || last->import_id == import_id || !is_last(last->stage)) {
        return Nanoseconds(0);
    }
    return std::clamp(stands - age, Nanoseconds(0), stands);
}

} // namespace frustumscreen::library
