/// Reports an import's progress: a file, lines for the journal, and a progress line on a terminal.
///
/// Threads  one caller.
#pragma once

#include "app/library/import_report.h"
#include "app/programs/common/progress_line.h"
#include "firmware_host/base/time.h"

#include <filesystem>
#include <optional>

namespace frustumscreen::programs {

class ImportWatcher {
public:
    /// `file`: empty: no file. `lines`: a line for each stage on standard output.
    ImportWatcher(std::filesystem::path file, bool lines) : file_(std::move(file)), lines_(lines) {}
    /// Reports a new stage at once, and copying a few times a second.
    void tell(const library::ImportReport& report, MonotonicTime now);

private:
    void write(const library::ImportReport& report);
    std::filesystem::path file_;
    bool lines_;
    bool complained_ = false;
    ProgressLine progress_;
    std::optional<library::ImportStage> stage_;
    MonotonicTime written_{};
};

/// The outcome of a pack in a word or two.
[[nodiscard]] std::string_view words_of(library::ImportOutcome outcome);

} // namespace frustumscreen::programs
