/// Frame times and errors, one line for each artifact and level, as Markdown or as a page.
#pragma once

#include "app/programs/sheet/sheet_frames.h"

#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::programs {

struct TableLine {
    std::string artifact;
    std::string technique;
    /// Drawn frames; excludes the first of a run, which compiles shaders, if there are more.
    std::size_t frames = 0;
    std::size_t unchanged = 0;
    double median_ms = 0.0;
    double p99_ms = 0.0;
    std::optional<double> estimated_error_mm; ///< mean over the frames that show a part of it
};

/// In the order of first appearance.
[[nodiscard]] std::vector<TableLine> table_lines(const std::vector<FrameRecord>& records);
[[nodiscard]] std::string markdown_table(const std::vector<TableLine>& lines);
/// One self-contained page.
[[nodiscard]] std::string html_table(const std::vector<TableLine>& lines, const std::string& title);

} // namespace frustumscreen::programs
