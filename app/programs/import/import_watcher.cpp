#include "app/programs/import/import_watcher.h"

#include "app/programs/common/guarded_main.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>

namespace frustumscreen::programs {

namespace {

constexpr Nanoseconds between_reports = std::chrono::milliseconds(300);
constexpr double bytes_per_mb = 1e6;

double share_of(const library::ImportReport& report) {
    return static_cast<double>(report.done_bytes) /
           static_cast<double>(std::max<std::uint64_t>(report.total_bytes, 1));
}

std::string line_of(const library::ImportReport& report) {
    switch (report.stage) {
    case library::ImportStage::Found:
        return "a stick is being checked";
    case library::ImportStage::Copying: // each byte is copied, then checked
        return fmt::format("{:.1f} MB are copied and checked",
                           static_cast<double>(report.total_bytes) / 2.0 / bytes_per_mb);
    case library::ImportStage::MayTakeOut:
        return fmt::format("the stick may be taken out; set {} is installed", report.set_number);
    case library::ImportStage::Done:
        return "done";
    case library::ImportStage::Failed:
        break;
    }
    const bool has_taken =
        std::any_of(report.packs.begin(), report.packs.end(), [](const library::ImportedPack& pack) {
            return pack.outcome == library::ImportOutcome::Taken;
        });
    return has_taken ? "packs were taken, but something is wrong" : "nothing was taken";
}

} // namespace

std::string_view words_of(library::ImportOutcome outcome) {
    constexpr std::array<std::string_view, 7> words{"pending", "taken",   "already there", "refused",
                                                    "removed", "written", "not written"};
    return words[static_cast<std::size_t>(outcome)];
}

void ImportWatcher::tell(const library::ImportReport& report, MonotonicTime now) {
    const bool is_new_stage = stage_ != report.stage;
    if (report.stage == library::ImportStage::Copying) {
        progress_.show_share("copying and checking", share_of(report));
    }
    if (!is_new_stage && now - written_ < between_reports) {
        return;
    }
    written_ = now;
    stage_ = report.stage;
    write(report);
    if (is_new_stage && lines_) {
        progress_.clear();
        fmt::print("{}\n", line_of(report));
        std::fflush(stdout); // the journal receives each line at once
    }
}

/// A report that cannot be written causes one message and does not stop the import.
void ImportWatcher::write(const library::ImportReport& report) {
    if (file_.empty()) {
        return;
    }
    const Result<void> written = write_file(file_, as_bytes(library::write_import_report(report)));
    if (!written && !complained_) {
        complained_ = true;
        complain("frustumscreen-import", written.error());
    }
}

} // namespace frustumscreen::programs
