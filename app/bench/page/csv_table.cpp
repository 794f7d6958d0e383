#include "app/bench/page/csv_table.h"

#include "firmware_host/base/printable.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace frustumscreen::bench {

Result<CsvTable> CsvTable::parse(std::string_view text, std::string file) {
    CsvTable table(std::move(file));
    std::size_t line = 1;
    TRY(Row header, table.take_row(text, line));
    table.columns_ = std::move(header.fields);
    while (!text.empty()) {
        TRY(Row row, table.take_row(text, line));
        if (row.fields.size() != table.columns_.size()) {
            return bad_input("csv.fields",
                             "{}, line {}: there are {} fields, the first line names {} columns; measure "
                             "again",
                             table.file_, row.line, row.fields.size(), table.columns_.size());
        }
        table.rows_.push_back(std::move(row));
    }
    return table;
}

Result<CsvTable::Row> CsvTable::take_row(std::string_view& text, std::size_t& line) const {
    Row row{line, {std::string()}};
    bool quoted = false;
    std::size_t k = 0;
    for (; k < text.size(); ++k) {
        const char c = text[k];
        line += c == '\n' ? 1 : 0;
        if (c == '"') {
            if (quoted && k + 1 < text.size() && text[k + 1] == '"') {
                row.fields.back() += c;
                ++k;
            } else {
                quoted = !quoted;
            }
        } else if (!quoted && c == ',') {
            row.fields.emplace_back();
        } else if (!quoted && c == '\n') {
            ++k;
            break;
        } else if (quoted || c != '\r') {
            row.fields.back() += c;
        }
    }
    if (quoted) {
        return bad_input("csv.quote", "{}, line {}: a quote is opened and not closed; measure again", file_,
                         row.line);
    }
    text.remove_prefix(k);
    return row;
}

Result<std::size_t> CsvTable::column_of(std::string_view name) const {
    const auto found = std::find(columns_.begin(), columns_.end(), name);
    if (found == columns_.end()) {
        return bad_input("csv.column",
                         "{}, line 1: the column '{}' is missing; measure again with this "
                         "frustumscreen-bench",
                         file_, name);
    }
    return static_cast<std::size_t>(found - columns_.begin());
}

Result<std::string> CsvTable::text(std::size_t row, std::string_view column) const {
    TRY(const std::size_t k, column_of(column));
    return rows_[row].fields[k];
}

Result<double> CsvTable::number(std::size_t row, std::string_view column) const {
    TRY(const std::string field, text(row, column));
    double value = 0.0;
    const char* const end = field.data() + field.size();
    const auto [stop, failed] = std::from_chars(field.data(), end, value);
    if (failed != std::errc() || stop != end || !std::isfinite(value)) {
        return bad_input(
            "csv.number",
            "{}, line {}, column '{}': '{}' is not a number; a finite decimal number is allowed, "
            "measure again",
            file_, rows_[row].line, column, printable(field));
    }
    return value;
}

} // namespace frustumscreen::bench
