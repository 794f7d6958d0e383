#include "app/bench/page/fill_page.h"

#include "app/bench/page/report_tables.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/folder_entries.h"

#include <algorithm>
#include <map>
#include <optional>

namespace frustumscreen::bench {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t csv_limit_bytes = std::uintmax_t{256} << 20;

/// Reads the files of one run. No value: one of them is not there.
Result<std::optional<MeasuredRun>> read_run(const fs::path& folder, const ReportTable& table) {
    MeasuredRun run{folder.filename().string(), {}};
    for (const std::string& name : table.files) {
        const fs::path path = folder / name;
        std::error_code failed;
        if (!fs::exists(path, failed)) {
            return std::optional<MeasuredRun>();
        }
        TRY(const Bytes bytes, read_file(path, csv_limit_bytes));
        TRY(CsvTable csv, CsvTable::parse(as_text(bytes), path.string()));
        run.files.push_back(std::move(csv));
    }
    return std::optional(std::move(run));
}

/// The folders that may hold a run of the table, by name.
std::vector<fs::path> run_folders(const fs::path& folder, const ReportTable& table) {
    if (!table.one_folder_each) {
        return {folder / table.folder};
    }
    std::vector<fs::path> folders;
    for (const fs::directory_entry& entry : entries_of(folder / table.folder)) {
        std::error_code not_read;
        if (entry.is_directory(not_read)) {
            folders.push_back(entry.path());
        }
    }
    return folders;
}

std::string source_of(const fs::path& folder, const ReportTable& table) {
    std::string source;
    for (const std::string& file : table.files) {
        const fs::path where = folder / table.folder / (table.one_folder_each ? "*" : "") / file;
        source += (source.empty() ? "" : ", ") + where.string();
    }
    return source;
}

/// The table as Markdown, `old_text` if the runs have nothing of it.
Result<std::string> text_of(const ReportTable& table, const fs::path& folder, std::string_view old_text,
                            FilledTable& filled) {
    std::vector<MeasuredRun> runs;
    for (const fs::path& run_folder : run_folders(folder, table)) {
        TRY(std::optional<MeasuredRun> run, read_run(run_folder, table));
        if (run) {
            runs.push_back(*std::move(run));
        }
    }
    filled.source = source_of(folder, table);
    if (runs.empty()) {
        return std::string(old_text);
    }
    TRY(const TableCells rows, table.rows(runs));
    if (rows.empty()) {
        filled.state = TableState::NoRows;
        return std::string(old_text);
    }
    std::string text = markdown_table(table.header, rows);
    filled.state = text == old_text ? TableState::Same : TableState::Changed;
    return text;
}

std::string all_names(const std::vector<ReportTable>& tables) {
    std::string names;
    for (const ReportTable& table : tables) {
        names += (names.empty() ? "" : ", ") + table.name;
    }
    return names;
}

} // namespace

Result<FilledPage> fill_page(std::string_view page, std::string_view page_file, const fs::path& folder) {
    TRY(const std::vector<MarkedTable> marked, marked_tables(page, page_file));
    const std::vector<ReportTable> known = all_report_tables();
    std::map<std::string, std::string> texts;
    FilledPage filled;
    for (const MarkedTable& mark : marked) {
        const auto table = std::find_if(known.begin(), known.end(),
                                        [&mark](const ReportTable& one) { return one.name == mark.name; });
        if (table == known.end()) {
            return bad_input("report.table", "{}, line {}: there is no table '{}'; the tables are {}",
                             page_file, mark.line, mark.name, all_names(known));
        }
        FilledTable& one = filled.tables.emplace_back(FilledTable{mark.name, TableState::Absent, {}});
        TRY(texts[mark.name], text_of(*table, folder, page.substr(mark.begin, mark.end - mark.begin), one));
    }
    const auto is_absent = [](const FilledTable& table) { return table.state == TableState::Absent; };
    if (std::all_of(filled.tables.begin(), filled.tables.end(), is_absent)) {
        return bad_input("report.no_csv",
                         "{}: no table of {} has its CSV files there; docs/bench.md says which folder each "
                         "command writes to",
                         folder.string(), page_file);
    }
    filled.text = with_tables(page, marked, texts);
    return filled;
}

std::string line_of(const FilledTable& table, bool check) {
    switch (table.state) {
    case TableState::Absent:
        return fmt::format("{}: unchanged, because {} is missing", table.name, table.source);
    case TableState::NoRows:
        return fmt::format("{}: unchanged, because {} has no row for it", table.name, table.source);
    case TableState::Same:
        return fmt::format("{}: is as measured", table.name);
    case TableState::Changed:
        return fmt::format("{}: {}", table.name, check ? "differs from " + table.source : "written");
    }
    return {};
}

} // namespace frustumscreen::bench
