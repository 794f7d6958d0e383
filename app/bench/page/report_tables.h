/// The tables of docs/measurements.md that `frustumscreen-bench report` writes, each from the CSV files that one
/// command or test left in a folder.
///
/// Cost     of a picture: in every table processor time as a multiple of the floor (`cpu_times_floor`), "x floor".
/// Threads  pure; any.
/// Errors   as csv_table.h.
#pragma once

#include "app/bench/page/csv_table.h"
#include "app/bench/page/marked_page.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::bench {

/// The CSV files that one run of a command left in its folder.
struct MeasuredRun {
    std::string name;            ///< the folder's
    std::vector<CsvTable> files; ///< in the order of `ReportTable::files`
};

struct ReportTable {
    std::string name;               ///< in the page's mark
    std::string folder;             ///< below the folder of all measurements
    bool one_folder_each = false;   ///< `folder` has a folder for each artifact (or group), with its name
    std::vector<std::string> files; ///< CSV files of a run
    std::vector<std::string> header;
    /// No rows: the runs have nothing that belongs into the table.
    std::function<Result<TableCells>(std::span<const MeasuredRun>)> rows;
};

/// The tables of `error-time`: errors and cost of a frame.
[[nodiscard]] std::vector<ReportTable> error_time_tables();
/// The tables of `estimate`, `projection` and `shimmer`: the errors that the exhibit estimates, and the visitor's view.
[[nodiscard]] std::vector<ReportTable> view_tables();
/// The table of recordings of hands, replayed by `latency`; it is in docs/bench.md.
[[nodiscard]] ReportTable hand_table();
/// The tables of `scaling`, `stability`, `latency` and `ladder`, which need no pack.
[[nodiscard]] std::vector<ReportTable> packless_tables();
/// The tables of parts beside the picture: zones, bakes, texts and the camera's thread.
[[nodiscard]] std::vector<ReportTable> part_tables();
/// All of them. No two have one name.
[[nodiscard]] std::vector<ReportTable> all_report_tables();

} // namespace frustumscreen::bench
