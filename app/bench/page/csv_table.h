/// One of the bench's tables, read back from its CSV file (RFC 4180): the first line names the columns.
///
/// Threads  pure; any.
/// Errors   a line with another number of fields, an open quote, a missing column, a field that is no number:
///          each names the file, the line and the column.
#pragma once

#include "firmware_host/base/result.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::bench {

class CsvTable {
public:
    /// `file` is the name in errors.
    [[nodiscard]] static Result<CsvTable> parse(std::string_view text, std::string file);

    [[nodiscard]] std::size_t size() const { return rows_.size(); }
    [[nodiscard]] const std::string& file() const { return file_; }
    [[nodiscard]] Result<std::string> text(std::size_t row, std::string_view column) const;
    /// Only a finite decimal number is one.
    [[nodiscard]] Result<double> number(std::size_t row, std::string_view column) const;

private:
    struct Row {
        std::size_t line = 1; ///< on which it begins
        std::vector<std::string> fields;
    };
    explicit CsvTable(std::string file) : file_(std::move(file)) {}
    /// Takes one row off the front of `text`.
    [[nodiscard]] Result<Row> take_row(std::string_view& text, std::size_t& line) const;
    [[nodiscard]] Result<std::size_t> column_of(std::string_view name) const;

    std::string file_;
    std::vector<std::string> columns_;
    std::vector<Row> rows_;
};

} // namespace frustumscreen::bench
