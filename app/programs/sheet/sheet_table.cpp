#include "app/programs/sheet/sheet_table.h"

#include "firmware_host/base/quantile.h"
#include "firmware_host/base/xml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace frustumscreen::programs {

namespace {

constexpr std::array<std::string_view, 8> headings{"artifact",  "level",   "frames drawn",  "unchanged",
                                                   "median ms", "99 % ms", "99 % / median", "mean error mm"};

std::array<std::string, 8> cells(const TableLine& line) {
    return {line.artifact,
            line.technique,
            std::to_string(line.frames),
            std::to_string(line.unchanged),
            fmt::format("{:.2f}", line.median_ms),
            fmt::format("{:.2f}", line.p99_ms),
            line.median_ms > 0.0 ? fmt::format("{:.2f}", line.p99_ms / line.median_ms) : "",
            line.estimated_error_mm ? fmt::format("{:.3f}", *line.estimated_error_mm) : ""};
}

} // namespace

std::vector<TableLine> table_lines(const std::vector<FrameRecord>& records) {
    std::vector<TableLine> lines;
    std::vector<std::vector<double>> times;
    std::vector<std::vector<double>> errors_mm;
    for (std::size_t k = 0; k < records.size(); ++k) {
        const FrameRecord& record = records[k];
        auto line = std::find_if(lines.begin(), lines.end(), [&](const TableLine& l) {
            return l.artifact == record.artifact && l.technique == record.technique;
        });
        if (line == lines.end()) {
            lines.push_back({.artifact = record.artifact,
                             .technique = record.technique,
                             .frames = 0,
                             .unchanged = 0,
                             .median_ms = 0.0,
                             .p99_ms = 0.0,
                             .estimated_error_mm = std::nullopt});
            times.emplace_back();
            errors_mm.emplace_back();
            line = lines.end() - 1;
        }
        if (record.estimated_error_mm) {
            errors_mm[static_cast<std::size_t>(line - lines.begin())].push_back(*record.estimated_error_mm);
        }
        if (!record.drawn) {
            ++line->unchanged;
        } else if (k > 0 || records.size() == 1) {
            times[static_cast<std::size_t>(line - lines.begin())].push_back(record.ms);
        }
    }
    for (std::size_t k = 0; k < lines.size(); ++k) {
        lines[k].frames = times[k].size();
        if (!times[k].empty()) {
            lines[k].median_ms = quantile(times[k], 0.5);
            lines[k].p99_ms = quantile(times[k], 0.99);
        }
        if (!errors_mm[k].empty()) {
            lines[k].estimated_error_mm = std::accumulate(errors_mm[k].begin(), errors_mm[k].end(), 0.0) /
                                          static_cast<double>(errors_mm[k].size());
        }
    }
    return lines;
}

std::string markdown_table(const std::vector<TableLine>& lines) {
    std::string text = fmt::format("| {} |\n| --- | --- |{}\n", fmt::join(headings, " | "),
                                   " ---: | ---: | ---: | ---: | ---: | ---: |");
    for (const TableLine& line : lines) {
        std::array<std::string, 8> row = cells(line);
        std::replace(row[0].begin(), row[0].end(), '|', '/');
        text += fmt::format("| {} |\n", fmt::join(row, " | "));
    }
    return text;
}

std::string html_table(const std::vector<TableLine>& lines, const std::string& title) {
    std::string rows = "<tr><th>" + fmt::format("{}", fmt::join(headings, "</th><th>")) + "</th></tr>\n";
    for (const TableLine& line : lines) {
        std::array<std::string, 8> row = cells(line);
        std::transform(row.begin(), row.end(), row.begin(), xml_text);
        rows += fmt::format("<tr><td>{}</td></tr>\n", fmt::join(row, "</td><td>"));
    }
    return fmt::format(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title>\n"
        "<style>body{{background:#0e0f12;color:#e8e8e4;font:15px/1.5 sans-serif;margin:2em}}\n"
        "table{{border-collapse:collapse}}th{{color:#8a8e96;font-weight:normal}}\n"
        "th,td{{padding:.35em 1.1em .35em 0;text-align:right;border-bottom:1px solid #26282e}}\n"
        "th:nth-child(-n+2),td:nth-child(-n+2){{text-align:left}}p{{color:#8a8e96}}</style></head>\n"
        "<body><h1>{0}</h1>\n<table>\n{1}</table>\n"
        "<p>Times from the tracker\u2019s poll to the finished picture; the error is the mean "
        "of the frames\u2019 estimated distances from the source\u2019s surface on the configured prop.</p>\n"
        "</body></html>\n",
        xml_text(title), rows);
}

} // namespace frustumscreen::programs
