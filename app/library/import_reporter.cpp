#include "app/library/import_reporter.h"

#include "firmware_host/base/printable.h"

#include <algorithm>

namespace frustumscreen::library {

namespace {

constexpr Nanoseconds between_reports = std::chrono::milliseconds(100); ///< during a copy

} // namespace

ImportReporter::ImportReporter(const ImportRequest& request, const ImportEnvironment& outside,
                               const StickContents& contents)
    : request_(request), outside_(outside), contents_(contents) {
    report_.import_id = request.import_id;
    report_.stick = printable(request.stick);
}

void ImportReporter::tell(ImportStage stage) {
    report_.stage = stage;
    told_ = outside_.now();
    report_.packs = lines_of(contents_, request_, removed_);
    outside_.tell(report_);
}

void ImportReporter::progress(std::uint64_t bytes) {
    report_.done_bytes = std::min(bytes, report_.total_bytes);
    if (outside_.now() - told_ >= between_reports) {
        tell(ImportStage::Copying);
    }
}

void ImportReporter::tell_failed(const ImportFailure& failure) {
    report_.refusal = failure.refusal;
    report_.reason = failure.reason;
    tell(ImportStage::Failed);
}

} // namespace frustumscreen::library
