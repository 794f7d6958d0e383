/// Formats numbers for the tables of a page, and selects rows of a CSV table by a field's text.
///
/// Threads  pure; any.
#pragma once

#include "app/bench/page/csv_table.h"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::bench {

[[nodiscard]] inline std::string decimals(double value, int count) {
    return fmt::format("{:.{}f}", value, count);
}
/// In multiples of the floor: 5.6, from 20 on without decimals.
[[nodiscard]] inline std::string cost_cell(double times_floor) {
    return decimals(times_floor, times_floor < 19.95 ? 1 : 0);
}
/// "12,345"
[[nodiscard]] std::string grouped_cell(double whole_number);
/// "0.0071 %": two decimals, and below 0.1 % two digits that are not leading zeros.
[[nodiscard]] std::string percent_cell(double share);

/// Rows whose field in `column` is `text`.
[[nodiscard]] Result<std::vector<std::size_t>> rows_with(const CsvTable& table, std::string_view column,
                                                         std::string_view text);
/// Those of `rows` that also have `text` in `column`.
[[nodiscard]] Result<std::vector<std::size_t>> rows_with(const CsvTable& table,
                                                         const std::vector<std::size_t>& rows,
                                                         std::string_view column, std::string_view text);
/// The column's numbers in `rows`.
[[nodiscard]] Result<std::vector<double>>
numbers_in(const CsvTable& table, const std::vector<std::size_t>& rows, std::string_view column);
/// The mean; `values` is not empty.
[[nodiscard]] double mean_of(const std::vector<double>& values);

} // namespace frustumscreen::bench
