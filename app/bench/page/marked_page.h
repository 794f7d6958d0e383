/// A Markdown page with tables that a program writes, each between two lines of its own:
///
///     <!-- table: NAME -->
///     <!-- end -->
///
/// Everything else is prose and stays as it is, byte by byte.
///
/// Threads  pure; any.
/// Errors   a mark that is opened and not ended, an end without a table, a name that occurs twice: each names
///          file and line.
#pragma once

#include "firmware_host/base/result.h"

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::bench {

/// A table's place in the page, without its marks.
struct MarkedTable {
    std::string name;
    std::size_t line = 0;           ///< of its first mark, from 1
    std::size_t begin = 0, end = 0; ///< bytes of the page
};

/// In the page's order. `file` is the name in errors.
[[nodiscard]] Result<std::vector<MarkedTable>> marked_tables(std::string_view page, std::string_view file);

/// The page with the `texts` (by name) in place of the tables that have them.
[[nodiscard]] std::string with_tables(std::string_view page, const std::vector<MarkedTable>& tables,
                                      const std::map<std::string, std::string>& texts);

using TableCells = std::vector<std::vector<std::string>>;
/// Markdown, a line break at the end. A first cell that repeats the one above it is left empty.
[[nodiscard]] std::string markdown_table(const std::vector<std::string>& header, const TableCells& rows);

} // namespace frustumscreen::bench
