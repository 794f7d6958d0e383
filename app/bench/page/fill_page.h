/// Fills the tables of a page from the CSV files of measurements, and reports for each table whether it changed.
///
/// Threads  one.
/// Errors   as csv_table.h and marked_page.h; a mark that names no table; a folder without any CSV of a table.
#pragma once

#include "firmware_host/base/result.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::bench {

enum class TableState {
    Absent,  ///< its CSV is not there
    NoRows,  ///< the CSV has nothing of it, as with one set-up alone
    Same,    ///< the page has what the CSV says
    Changed, ///< the page has something else
};

struct FilledTable {
    std::string name;
    TableState state = TableState::Absent;
    std::string source; ///< the CSV files, as a path with '*' for the folders of artifacts
};

struct FilledPage {
    std::string text;                ///< tables that are `Absent` or have `NoRows` are as they were
    std::vector<FilledTable> tables; ///< in the page's order
};

/// `page_file` is the name in errors; `folder` has the folders of the measurements.
[[nodiscard]] Result<FilledPage> fill_page(std::string_view page, std::string_view page_file,
                                           const std::filesystem::path& folder);

/// "NAME: written", one line; `check`: the page is not written.
[[nodiscard]] std::string line_of(const FilledTable& table, bool check);

} // namespace frustumscreen::bench
