#include "app/bench/page/report_tables.h"
#include "app/bench/page/table_cells.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen::bench {

namespace {

/// "44 x 15"
Result<std::string> size_cell(const CsvTable& table, std::size_t row, std::string_view width,
                              std::string_view depth) {
    TRY(const double width_m, table.number(row, width));
    TRY(const double depth_m, table.number(row, depth));
    return fmt::format("{:.0f} x {:.0f}", 1e2 * width_m, 1e2 * depth_m);
}

Result<double> picture_area(const CsvTable& table, std::size_t row) {
    TRY(const double width_m, table.number(row, "picture_width_m"));
    TRY(const double depth_m, table.number(row, "picture_depth_m"));
    return width_m * depth_m;
}

Result<TableCells> zone_rows(std::span<const MeasuredRun> runs) {
    constexpr double caption_m = 0.01;
    const CsvTable& table = runs.front().files[0];
    TableCells rows;
    for (std::size_t row = 0; row < table.size(); ++row) {
        TRY(const double throw_ratio, table.number(row, "throw_ratio"));
        TRY(const std::string picture, size_cell(table, row, "picture_width_m", "picture_depth_m"));
        TRY(const std::string zone, size_cell(table, row, "zone_width_m", "zone_depth_m"));
        TRY(const double pixels, table.number(row, "pixels"));
        TRY(const double first_area, picture_area(table, 0));
        TRY(const double area, picture_area(table, row));
        TRY(const double pixels_a_metre, table.number(row, "pixels_a_metre"));
        rows.push_back({fmt::format("{:g}", throw_ratio), picture, zone,
                        grouped_cell(1e2 * std::round(1e-2 * pixels)), decimals(first_area / area, 2),
                        decimals(caption_m * pixels_a_metre, 0)});
    }
    return rows;
}

Result<TableCells> bake_rows(std::span<const MeasuredRun> runs) {
    TableCells rows;
    for (const MeasuredRun& run : runs) {
        const CsvTable& table = run.files[0];
        for (std::size_t row = 0; row < table.size(); ++row) {
            TRY(const double levels, table.number(row, "levels"));
            TRY(const double processor_s, table.number(row, "processor_seconds"));
            TRY(const double memory_bytes, table.number(row, "memory_bytes"));
            TRY(const double pack_bytes, table.number(row, "pack_bytes"));
            rows.push_back({run.name, decimals(levels, 0), decimals(processor_s, 1),
                            decimals(1e-6 * memory_bytes, 0), decimals(1e-6 * pack_bytes, 2)});
        }
    }
    return rows;
}

/// A script, and the language of the test's text in it.
struct Script {
    const char* name;
    const char* language;
};
constexpr std::array scripts = {Script{"Latin", "en"},    Script{"Greek", "el"},      Script{"Arabic", "ar"},
                                Script{"Hebrew", "he"},   Script{"Devanagari", "hi"}, Script{"Thai", "th"},
                                Script{"Japanese", "ja"}, Script{"Chinese", "zh"}};

Result<TableCells> text_rows(std::span<const MeasuredRun> runs) {
    const CsvTable& table = runs.front().files[0];
    TRY(std::vector<std::size_t> shipped, rows_with(table, "texels_per_em", "48"));
    TRY(shipped, rows_with(table, shipped, "spread_texels", "2"));
    TableCells rows;
    for (const Script& script : scripts) {
        TRY(const std::vector<std::size_t> own, rows_with(table, shipped, "language", script.language));
        if (own.empty()) {
            continue;
        }
        TRY(const double bytes, table.number(own.front(), "atlas_bytes"));
        TRY(const double at_20, table.number(own.front(), "rms_at_20_px"));
        TRY(const double at_60, table.number(own.front(), "rms_at_60_px"));
        rows.push_back({script.name, decimals(1e-3 * bytes, 1), decimals(at_20, 1), decimals(at_60, 1)});
    }
    return rows;
}

/// The figure in `column` with one decimal, times `factor`; empty if it was not measured or is 0.
Result<std::string> camera_cell(const CsvTable& table, const std::vector<std::size_t>& rows,
                                std::string_view column, double factor, const char* unit) {
    if (rows.empty()) {
        return std::string();
    }
    TRY(const double figure, table.number(rows.front(), column));
    return figure > 0.0 ? decimals(factor * figure, 1) + unit : std::string();
}

Result<TableCells> camera_rows(std::span<const MeasuredRun> runs) {
    const CsvTable& table = runs.front().files[0];
    std::vector<std::string> uses;
    for (std::size_t row = 0; row < table.size(); ++row) {
        TRY(const std::string use, table.text(row, "use"));
        if (std::find(uses.begin(), uses.end(), use) == uses.end()) {
            uses.push_back(use);
        }
    }
    TableCells rows;
    for (const std::string& use : uses) {
        TRY(const std::vector<std::size_t> own, rows_with(table, "use", use));
        TRY(const std::vector<std::size_t> all_frames, rows_with(table, own, "max_share", "1.00"));
        TRY(const std::vector<std::size_t> as_run, rows_with(table, own, "max_share", "0.25"));
        TRY(const std::string share_of_all, camera_cell(table, all_frames, "share", 100.0, " %"));
        TRY(const std::string share, camera_cell(table, as_run, "share", 100.0, " %"));
        TRY(const std::string poses, camera_cell(table, as_run, "poses_hz", 1.0, ""));
        TRY(const std::string heads, camera_cell(table, as_run, "heads_hz", 1.0, ""));
        rows.push_back({use, share_of_all, share, poses, heads});
    }
    return rows;
}

} // namespace

std::vector<ReportTable> part_tables() {
    return {{.name = "zones",
             .folder = "zones",
             .one_folder_each = false,
             .files = {"zones.csv"},
             .header = {"throw ratio", "picture, cm", "zone, cm", "pixels on the ellipsoid", "light",
                        "caption of 10 mm, pixels"},
             .rows = zone_rows},
            {.name = "bakes",
             .folder = "bakes",
             .one_folder_each = true,
             .files = {"bakes.csv"},
             .header = {"model", "levels", "processor s", "memory MB", "pack MB"},
             .rows = bake_rows},
            {.name = "texts",
             .folder = "tests",
             .one_folder_each = false,
             .files = {"texts.csv"},
             .header = {"script", "kB", "at 20", "at 60"},
             .rows = text_rows},
            {.name = "camera",
             .folder = "tests",
             .one_folder_each = false,
             .files = {"camera_share.csv"},
             .header = {"use", "all 30 frames", "as the exhibit runs it", "poses a second", "heads a second"},
             .rows = camera_rows}};
}

} // namespace frustumscreen::bench
