#include "app/bench/page/table_cells.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace frustumscreen::bench {

std::string grouped_cell(double whole_number) {
    std::string digits = fmt::format("{:.0f}", whole_number);
    for (std::size_t k = digits.size(); k > 3; k -= 3) {
        if (digits[k - 4] != '-') {
            digits.insert(k - 3, ",");
        }
    }
    return digits;
}

std::string percent_cell(double share) {
    const double percent = 100.0 * share;
    const double size = std::abs(percent);
    const int zeros = size > 0.0 && size < 0.1 ? static_cast<int>(-std::floor(std::log10(size))) : 1;
    return fmt::format("{:.{}f} %", percent, std::min(zeros + 1, 12));
}

Result<std::vector<std::size_t>> rows_with(const CsvTable& table, const std::vector<std::size_t>& rows,
                                           std::string_view column, std::string_view text) {
    std::vector<std::size_t> found;
    for (const std::size_t row : rows) {
        TRY(const std::string field, table.text(row, column));
        if (field == text) {
            found.push_back(row);
        }
    }
    return found;
}

Result<std::vector<std::size_t>> rows_with(const CsvTable& table, std::string_view column,
                                           std::string_view text) {
    std::vector<std::size_t> all(table.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return rows_with(table, all, column, text);
}

Result<std::vector<double>> numbers_in(const CsvTable& table, const std::vector<std::size_t>& rows,
                                       std::string_view column) {
    std::vector<double> numbers;
    for (const std::size_t row : rows) {
        TRY(const double number, table.number(row, column));
        numbers.push_back(number);
    }
    return numbers;
}

double mean_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

} // namespace frustumscreen::bench
