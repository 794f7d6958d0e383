#include "app/bench/page/marked_page.h"

#include <algorithm>

namespace frustumscreen::bench {

namespace {

constexpr std::string_view first_mark = "<!-- table:";
constexpr std::string_view close = "-->";
constexpr std::string_view last_mark = "<!-- end -->";

std::string_view without_blanks(std::string_view text) {
    constexpr std::string_view blanks = " \t\r";
    const std::size_t first = text.find_first_not_of(blanks);
    return first == std::string_view::npos ? std::string_view()
                                           : text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

/// The name in a table's first mark; empty if the line is none.
std::string name_in(std::string_view line) {
    if (!line.starts_with(first_mark) || !line.ends_with(close)) {
        return {};
    }
    line.remove_prefix(first_mark.size());
    line.remove_suffix(close.size());
    return std::string(without_blanks(line));
}

std::string row_of(const std::vector<std::string>& cells) {
    std::string row = "|";
    for (const std::string& cell : cells) {
        row += ' ';
        for (const char c : cell) {
            row += c == '|' ? "\\|" : std::string(1, c);
        }
        row += cell.empty() ? "|" : " |";
    }
    return row + "\n";
}

} // namespace

Result<std::vector<MarkedTable>> marked_tables(std::string_view page, std::string_view file) {
    std::vector<MarkedTable> tables;
    bool open = false;
    const auto not_ended = [&] {
        return bad_input("page.mark_open", "{}, line {}: the table '{}' has no line '{}'", file,
                         tables.back().line, tables.back().name, last_mark);
    };
    std::size_t number = 0;
    for (std::size_t begin = 0; begin < page.size();) {
        const std::size_t end = std::min(page.find('\n', begin), page.size() - 1) + 1;
        const std::string_view line =
            without_blanks(page.substr(begin, end - begin - (page[end - 1] == '\n' ? 1 : 0)));
        ++number;
        if (const std::string name = name_in(line); !name.empty()) {
            if (open) {
                return not_ended();
            }
            if (std::any_of(tables.begin(), tables.end(),
                            [&](const auto& one) { return one.name == name; })) {
                return bad_input("page.mark_twice", "{}, line {}: there is another table '{}' above", file,
                                 number, name);
            }
            tables.push_back({.name = name, .line = number, .begin = end, .end = end});
            open = true;
        } else if (line == last_mark) {
            if (!open) {
                return bad_input("page.mark_end", "{}, line {}: '{}' ends no table; put '{} NAME {}' above",
                                 file, number, last_mark, first_mark, close);
            }
            tables.back().end = begin;
            open = false;
        }
        begin = end;
    }
    if (open) {
        return not_ended();
    }
    return tables;
}

std::string with_tables(std::string_view page, const std::vector<MarkedTable>& tables,
                        const std::map<std::string, std::string>& texts) {
    std::string result;
    std::size_t copied = 0;
    for (const MarkedTable& table : tables) {
        if (const auto text = texts.find(table.name); text != texts.end()) {
            result += page.substr(copied, table.begin - copied);
            result += text->second;
            copied = table.end;
        }
    }
    return result + std::string(page.substr(copied));
}

std::string markdown_table(const std::vector<std::string>& header, const TableCells& rows) {
    std::string table = row_of(header) + "|";
    for (std::size_t k = 0; k < header.size(); ++k) {
        table += "---|";
    }
    table += "\n";
    std::string above;
    for (std::vector<std::string> cells : rows) {
        if (cells.front() == above) {
            cells.front().clear();
        } else {
            above = cells.front();
        }
        table += row_of(cells);
    }
    return table;
}

} // namespace frustumscreen::bench
