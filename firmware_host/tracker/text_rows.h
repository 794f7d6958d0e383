/// Rows of a text table, one after the other, and the numbers in them.
///
/// Lines end in LF or CRLF; blank lines and lines that begin with `#` are skipped.
/// Threads  one caller; the text must outlive the reader.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::tracker {

class TextRows {
public:
    /// `name` precedes the line number in messages.
    TextRows(std::string_view text, std::string_view name);

    /// Goes to the next row; false at the end.
    [[nodiscard]] bool next();
    /// The row's fields without surrounding blanks. A row that contains a comma is split at commas, any other
    /// at blanks.
    [[nodiscard]] const std::vector<std::string_view>& fields() const { return fields_; }
    /// `name:line: what`.
    [[nodiscard]] std::string located(std::string_view what) const;

private:
    void split(std::string_view line);

    std::string_view rest_;
    std::string name_;
    int line_ = 0;
    std::vector<std::string_view> fields_;
};

/// The whole field as a number, "nan" and "inf" included; nullopt if any character is left over.
[[nodiscard]] std::optional<double> number_in(std::string_view field);
[[nodiscard]] std::optional<std::int64_t> integer_in(std::string_view field);
/// The field in a form fit for a message: printable, not long, in quotes.
[[nodiscard]] std::string quoted(std::string_view field);

} // namespace frustumscreen::tracker
