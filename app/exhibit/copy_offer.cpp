#include "app/exhibit/copy_offer.h"

#include "app/library/report_request.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::exhibit {

namespace {

bool is_over(library::ImportStage stage) {
    return stage == library::ImportStage::Done || stage == library::ImportStage::Failed;
}

const library::ImportedPack* line_with(const library::ImportReport& report, library::ImportOutcome outcome) {
    const auto found =
        std::find_if(report.packs.begin(), report.packs.end(),
                     [&](const library::ImportedPack& line) { return line.outcome == outcome; });
    return found != report.packs.end() ? &*found : nullptr;
}

/// The state after a stick's first report.
CopyState offered_by(const library::ImportReport& report) {
    if (!is_over(report.stage)) {
        return {.stage = CopyStage::Looking};
    }
    const bool offers = std::any_of(report.packs.begin(), report.packs.end(), library::offers_copy);
    return {.stage = offers ? CopyStage::Offered : CopyStage::NoRequest};
}

/// The state after a report that follows the staff's confirmation.
CopyState written_by(const library::ImportReport& report) {
    if (!is_over(report.stage)) {
        const bool copies = report.stage == library::ImportStage::Copying && report.total_bytes > 0;
        const double share =
            copies ? static_cast<double>(report.done_bytes) / static_cast<double>(report.total_bytes) : 0.0;
        return {.stage = CopyStage::Writing, .percent = static_cast<int>(100.0 * std::min(share, 1.0))};
    }
    if (const auto* const failed = line_with(report, library::ImportOutcome::NotWritten)) {
        return {.stage = CopyStage::Failed, .said = failed->reason};
    }
    if (const auto* const written = line_with(report, library::ImportOutcome::Written)) {
        return {.stage = CopyStage::Written, .said = written->file};
    }
    return {.stage = CopyStage::Failed,
            .said = !report.reason.empty() ? report.reason : "the stick no longer asks for a copy"};
}

} // namespace

void CopyOffer::take(MonotonicTime now, const library::ImportReport& report, bool is_old) {
    const std::string_view id = report.import_id;
    const std::size_t ending = id.find(library::staff_import_ending);
    const bool is_confirmed = ending != std::string_view::npos;
    const std::string_view stick = id.substr(0, ending);
    if (state_.stage == CopyStage::Writing && (!is_confirmed || stick != stick_)) {
        return;
    }
    CopyState next = is_old ? CopyState{} : is_confirmed ? written_by(report) : offered_by(report);
    const bool writes = next.stage == CopyStage::Writing; // each report shows progress
    if (writes || stick != stick_ || next != state_) {
        since_ = now;
    }
    stick_ = stick;
    state_ = std::move(next);
}

void CopyOffer::confirm(MonotonicTime now) {
    if (state_.stage == CopyStage::Offered) {
        state_ = {.stage = CopyStage::Writing};
        since_ = now;
    }
}

const CopyState& CopyOffer::step(MonotonicTime now) {
    const Nanoseconds lasts = now - since_;
    switch (state_.stage) {
    case CopyStage::Offered:
    case CopyStage::NoRequest:
        if (lasts >= stands) {
            state_ = {};
        }
        break;
    case CopyStage::Looking:
        if (lasts >= timeout) {
            state_ = {};
        }
        break;
    case CopyStage::Writing:
        if (lasts >= timeout) {
            state_ = {.stage = CopyStage::Failed,
                      .said = "the stick has stopped answering; put it in again, or use another stick"};
        }
        break;
    case CopyStage::NoStick:
    case CopyStage::Written:
    case CopyStage::Failed:
        break;
    }
    return state_;
}

} // namespace frustumscreen::exhibit
