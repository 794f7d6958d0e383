#include "app/programs/batch/batch_report.h"

#include "app/programs/preview/html_parts.h"
#include "firmware_host/base/printable.h"
#include "firmware_host/base/words_of_time.h"
#include "firmware_host/base/xml_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace frustumscreen::programs {

namespace {

constexpr std::array all_statuses{BatchStatus::Baked, BatchStatus::Unchanged, BatchStatus::Failed,
                                  BatchStatus::Missing};

constexpr std::string_view style = R"(
body { margin: 0 auto; max-width: 120rem; padding: 1.5rem; color: #1d2024; background: #fbfaf7;
       font: 15px/1.5 system-ui, "Noto Sans", sans-serif; }
h1 { font: normal 1.9rem/1.2 Georgia, "Noto Serif", serif; margin: .5rem 0; }
table { width: 100%; border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: .35rem .9rem .35rem 0; text-align: right; vertical-align: top; border-bottom: 1px solid #dcdfe3; }
th { position: sticky; top: 0; font-weight: normal; color: #5b6169; background: #fbfaf7; }
th, td { white-space: nowrap; }
th.text, td.text { text-align: left; }
td.long { min-width: 20rem; white-space: normal; overflow-wrap: anywhere; }
tr.failed td, tr.missing td { background: #fdf4e0; }
p { color: #5b6169; }
a { color: #1f5f8b; }
)";

bool is_good(const BatchRow& row) {
    return row.status == BatchStatus::Baked || row.status == BatchStatus::Unchanged;
}

std::string csv_field(std::string_view text) {
    if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
        return std::string(text);
    }
    std::string quoted = "\"";
    for (const char c : text) {
        quoted += c == '"' ? "\"\"" : std::string(1, c);
    }
    return quoted + '"';
}

/// The figures of a good row; empty fields for any other.
std::vector<std::string> figures(const BatchRow& row) {
    if (!is_good(row)) {
        return std::vector<std::string>(6);
    }
    return {fmt::format("{}", row.levels),          fmt::format("{}", row.bytes),
            fmt::format("{:.4f}", row.mean_mm),     fmt::format("{:.4f}", row.p95_mm),
            fmt::format("{:.2f}", row.colour_rmse), fmt::format("{}", row.silent)};
}

/// Escapes a name as a part of a link, by RFC 3986.
std::string link_to(const std::string& name) {
    std::string link;
    for (const char c : name) {
        const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                              c == '-' || c == '_' || c == '.' || c == '~';
        link += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return "./" + link;
}

std::string page_row(const BatchRow& row) {
    const std::string name = xml_text(printable(row.object, 300));
    const std::string object =
        row.has_page && is_good(row)
            ? fmt::format("<a href=\"{}\">{}</a>", xml_text(link_to(row.object + ".html")), name)
            : name;
    std::string cells = fmt::format("<td class=\"text\">{}</td><td class=\"text\">{}</td><td>{:.0f}</td>",
                                    object, name_of(row.status), row.seconds);
    std::vector<std::string> numbers = figures(row);
    if (is_good(row)) {
        numbers[1] = bytes_in_words(row.bytes);
    }
    cells += fmt::format("<td>{}</td>", fmt::join(numbers, "</td><td>"));
    for (const ScanColumn& column : scan_columns()) {
        cells += fmt::format("<td{}>{}</td>", column.is_text ? " class=\"text\"" : "",
                             is_good(row) ? xml_text(column.shown(row.scan)) : std::string());
    }
    return fmt::format("<tr class=\"{}\">{}<td class=\"text long\">{}</td></tr>\n", name_of(row.status),
                       cells, xml_text(is_good(row) ? row.title : row.sentence));
}

} // namespace

std::size_t count_of(std::span<const BatchRow> rows, BatchStatus status) {
    return static_cast<std::size_t>(
        std::count_if(rows.begin(), rows.end(), [&](const BatchRow& row) { return row.status == status; }));
}

std::string summary(std::span<const BatchRow> rows) {
    std::vector<std::string> parts;
    for (const BatchStatus status : all_statuses) {
        if (const std::size_t count = count_of(rows, status); count > 0) {
            parts.push_back(fmt::format("{} {}", count, name_of(status)));
        }
    }
    return fmt::format("{} object{}{}{}", rows.size(), rows.size() == 1 ? "" : "s", parts.empty() ? "" : ": ",
                       fmt::join(parts, ", "));
}

std::string report_csv(std::span<const BatchRow> rows) {
    std::string text = "object,status,seconds,sentence,levels,bytes,mean_mm,p95_mm,colour_rmse,silent,title";
    for (const ScanColumn& column : scan_columns()) {
        text += fmt::format(",{}", column.key);
    }
    text += "\r\n";
    for (const BatchRow& row : rows) {
        text += fmt::format("{},{},{:.1f},{},{},{}", csv_field(row.object), name_of(row.status), row.seconds,
                            csv_field(row.sentence), fmt::join(figures(row), ","), csv_field(row.title));
        for (const ScanColumn& column : scan_columns()) {
            text += "," + (is_good(row) ? csv_field(column.plain(row.scan)) : std::string());
        }
        text += "\r\n";
    }
    return text;
}

std::string report_page(std::span<const BatchRow> rows, std::string_view title, double seconds,
                        std::span<const std::string> skipped) {
    std::string lines;
    for (const bool good : {false, true}) { // rows that need attention come first
        for (const BatchRow& row : rows) {
            lines += is_good(row) == good ? page_row(row) : std::string();
        }
    }
    std::string headings;
    for (const ScanColumn& column : scan_columns()) {
        headings += fmt::format("<th{}>{}</th>", column.is_text ? " class=\"text\"" : "", column.heading);
    }
    const std::string over = skipped.empty()
                                 ? std::string()
                                 : fmt::format("<p>Skipped folders without an artifact.toml: {}</p>\n",
                                               xml_text(fmt::format("{}", fmt::join(skipped, ", "))));
    return fmt::format(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src {}\">\n"
        "<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n<h1>{}</h1>\n<p>{}, in {}.</p>\n{}"
        "<table>\n<tr><th class=\"text\">object</th><th "
        "class=\"text\">status</th><th>seconds</th><th>levels</th>"
        "<th>size</th><th>mean mm</th><th>95 % mm</th><th>colour</th><th>silent</th>{}"
        "<th class=\"text\">title, or why not</th></tr>\n{}</table>\n<p>Distances are between the level that "
        "is usually "
        "shown and the scan; colour is in steps of 255. Lost, silent: the number of losses and of "
        "descriptions without speech. About: as frustumscreen-bake --check estimates it.</p>\n"
        "</body>\n</html>\n",
        policy_hash(style), xml_text(title), style, xml_text(title), summary(rows), words_of_time(seconds),
        over, headings, lines);
}

} // namespace frustumscreen::programs
