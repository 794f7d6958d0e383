/// The report of an import while it goes on: its stage, its progress and a line for each thing found.
///
/// Threads  one caller.
#pragma once

#include "app/library/import_stick.h"
#include "app/library/stick_contents.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace frustumscreen::library {

class ImportReporter {
public:
    /// The references must outlive the reporter. Each report has the lines of `contents` at that time.
    ImportReporter(const ImportRequest& request, const ImportEnvironment& outside,
                   const StickContents& contents);

    void tell(ImportStage stage);
    /// `bytes` of the total are done. A report has a line for each pack, so it is not told at each step.
    void progress(std::uint64_t bytes);
    /// Tells that the stick as a whole is refused.
    void tell_failed(const ImportFailure& failure);

    void set_number(std::uint64_t number) { report_.set_number = number; }
    void set_total_bytes(std::uint64_t bytes) { report_.total_bytes = bytes; }
    void set_all_done() { report_.done_bytes = report_.total_bytes; }
    /// The packs that the set file has removed from the set.
    void set_removed(std::vector<InstalledPack> removed) { removed_ = std::move(removed); }

    /// As it was last told.
    [[nodiscard]] const ImportReport& report() const { return report_; }

private:
    const ImportRequest& request_;
    const ImportEnvironment& outside_;
    const StickContents& contents_;
    std::vector<InstalledPack> removed_;
    ImportReport report_;
    MonotonicTime told_{};
};

} // namespace frustumscreen::library
