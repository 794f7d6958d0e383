#include "app/bench/page/report_tables.h"
#include "app/bench/page/table_cells.h"
#include "firmware_host/base/words_of_time.h"

#include <array>
#include <set>

namespace frustumscreen::bench {

namespace {

/// The cost of the technique whose name begins or ends so; empty if there is none.
Result<std::string> cost_of(const CsvTable& table, const std::vector<std::size_t>& rows,
                            std::string_view begins, std::string_view ends) {
    for (const std::size_t row : rows) {
        TRY(const std::string technique, table.text(row, "technique"));
        if (technique.starts_with(begins) && technique.ends_with(ends)) {
            TRY(const double cost, table.number(row, "cpu_times_floor"));
            return cost_cell(cost);
        }
    }
    return std::string();
}

Result<TableCells> scaling_rows(std::span<const MeasuredRun> runs) {
    TableCells rows;
    const CsvTable& table = runs.front().files[0];
    std::set<double> sizes;
    for (std::size_t row = 0; row < table.size(); ++row) {
        TRY(const double triangles, table.number(row, "source_triangles"));
        sizes.insert(triangles);
    }
    for (const double triangles : sizes) {
        TRY(const std::vector<std::size_t> own,
            rows_with(table, "source_triangles", fmt::format("{:.0f}", triangles)));
        TRY(const std::string relief, cost_of(table, own, "relief", ""));
        TRY(const std::string mesh, cost_of(table, own, "mesh", "(default)"));
        TRY(const std::string two_pass, cost_of(table, own, "two-pass", ""));
        rows.push_back({grouped_cell(triangles), relief, mesh, two_pass});
    }
    return rows;
}

ReportTable scaling_table_of(const std::string& name, const char* folder) {
    return {.name = name,
            .folder = folder,
            .one_folder_each = false,
            .files = {"scaling_near.csv"},
            .header = {"source triangles", "finest relief, x floor", "default mesh",
                       "two-pass, eye image of 1024"},
            .rows = scaling_rows};
}

/// The share that was observed for the quantity of theme `light`; empty if there is none.
Result<std::string> light_change(const CsvTable& table, const std::string& quantity) {
    TRY(std::vector<std::size_t> rows, rows_with(table, "theme", "light"));
    TRY(rows, rows_with(table, rows, "quantity", quantity));
    if (rows.empty()) {
        return std::string();
    }
    TRY(const double share, table.number(rows.front(), "observed"));
    return share == 0.0 ? std::string("0") : percent_cell(share);
}

Result<TableCells> light_rows(std::span<const MeasuredRun> runs) {
    TableCells rows;
    for (const std::string table : {"shipped", "steep prop"}) {
        std::vector<std::string> cells = {table};
        for (const char* change : {": light sent back, change a mm of the head", ": change a mm of the prop",
                                   ": change a turn of 0.05 deg"}) {
            TRY(std::string cell, light_change(runs.front().files[0], table + change));
            cells.push_back(std::move(cell));
        }
        if (!cells[1].empty()) {
            rows.push_back(std::move(cells));
        }
    }
    return rows;
}

constexpr const char* tracker_60_hz = "Polhemus PATRIOT";
constexpr const char* tracker_240_hz = "Polhemus VIPER";

/// A filter in the tables of latency: its words there, and its row in the CSV file.
struct Filtered {
    const char* words;
    const char* source;
    const char* filter_name;
};

/// One figure of a filter, in mm; empty if it was not measured.
Result<std::string> filtered_mm(const CsvTable& table, const Filtered& filtered, std::string_view motion,
                                double speed_m_s, std::string_view column, int shown_decimals) {
    TRY(std::vector<std::size_t> rows, rows_with(table, "source", filtered.source));
    TRY(rows, rows_with(table, rows, "contestant", filtered.filter_name));
    TRY(rows, rows_with(table, rows, "motion", motion));
    for (const std::size_t row : rows) {
        TRY(const double speed, table.number(row, "speed_m_s"));
        if (speed == speed_m_s || (motion != "strokes" && motion != "tremble")) {
            TRY(const double mm, table.number(row, column));
            return decimals(mm, shown_decimals);
        }
    }
    return std::string();
}

Result<TableCells> latency_rows(std::span<const MeasuredRun> runs) {
    constexpr std::array filters = {
        Filtered{"no filter", tracker_60_hz, "no filter"},
        Filtered{"exhibit's filter, not predicted", tracker_60_hz, "exhibit"},
        Filtered{"exhibit's filter, predicted, as shown", tracker_60_hz, "exhibit, as shown"},
        Filtered{"the same, 240 Hz tracker, 5 ms (VIPER)", tracker_240_hz, "exhibit, as shown"},
        Filtered{"constant-velocity Kalman, predicted", tracker_60_hz, "constant velocity, predicted"},
        Filtered{"One Euro, predicted", tracker_60_hz, "One Euro, predicted"}};
    struct Figure {
        const char* motion;
        double speed_m_s;
        const char* column;
        int shown_decimals;
    };
    constexpr std::array figures = {
        Figure{.motion = "strokes", .speed_m_s = 0.05, .column = "rms_mm", .shown_decimals = 2},
        Figure{.motion = "strokes", .speed_m_s = 0.25, .column = "rms_mm", .shown_decimals = 2},
        Figure{.motion = "strokes", .speed_m_s = 0.5, .column = "rms_mm", .shown_decimals = 2},
        Figure{.motion = "rest", .speed_m_s = 0.0, .column = "rms_mm", .shown_decimals = 3},
        Figure{.motion = "stop_overshoot", .speed_m_s = 0.0, .column = "mean_mm", .shown_decimals = 2},
        Figure{.motion = "stop_overshoot", .speed_m_s = 0.0, .column = "p95_mm", .shown_decimals = 2}};
    TableCells rows;
    for (const Filtered& filter : filters) {
        rows.push_back({filter.words});
        for (const Figure& figure : figures) {
            TRY(std::string cell, filtered_mm(runs.front().files[0], filter, figure.motion, figure.speed_m_s,
                                              figure.column, figure.shown_decimals));
            rows.back().push_back(std::move(cell));
        }
    }
    return rows;
}

Result<TableCells> tremble_rows(std::span<const MeasuredRun> runs) {
    constexpr std::array filters = {
        Filtered{"as shown, 60 Hz", tracker_60_hz, "exhibit, as shown"},
        Filtered{"as shown, 240 Hz", tracker_240_hz, "exhibit, as shown"},
        Filtered{"no filter, 60 Hz", tracker_60_hz, "no filter"},
        Filtered{"constant velocity, predicted, 60 Hz", tracker_60_hz, "constant velocity, predicted"}};
    TableCells rows;
    for (const Filtered& filter : filters) {
        rows.push_back({filter.words});
        for (const double speed_m_s : {0.002, 0.005, 0.015, 0.05, 0.15}) {
            TRY(std::string cell,
                filtered_mm(runs.front().files[0], filter, "tremble", speed_m_s, "rms_mm", 2));
            rows.back().push_back(std::move(cell));
        }
    }
    return rows;
}

/// "2 min", "12 h"
std::string duration_cell(double seconds) {
    constexpr std::string_view no_minutes = " 0 min";
    std::string words = words_of_time(seconds);
    if (words.ends_with(no_minutes)) {
        words.resize(words.size() - no_minutes.size());
    }
    return words;
}

Result<TableCells> ladder_rows(std::span<const MeasuredRun> runs) {
    const CsvTable& table = runs.front().files[0];
    TableCells rows;
    for (std::size_t row = 0; row < table.size(); ++row) {
        TRY(std::string policy, table.text(row, "policy"));
        rows.push_back({std::move(policy)});
        for (const char* column : {"whole", "untracked", "words", "dark"}) {
            TRY(const double share, table.number(row, column));
            rows.back().push_back(percent_cell(share));
        }
        TRY(const double longest_dark_s, table.number(row, "longest_dark_s"));
        rows.back().push_back(duration_cell(longest_dark_s));
        for (const char* column : {"reboots", "false_alarms"}) {
            TRY(const double count, table.number(row, column));
            rows.back().push_back(grouped_cell(count));
        }
    }
    return rows;
}

} // namespace

std::vector<ReportTable> packless_tables() {
    return {scaling_table_of("scaling_same_surface", "same_surface"),
            scaling_table_of("scaling_detail", "detail"),
            {.name = "light",
             .folder = "stability",
             .one_folder_each = false,
             .files = {"stability.csv"},
             .header = {"table", "a mm of the head", "a mm of the prop", "a turn of 0.05 degrees"},
             .rows = light_rows},
            {.name = "latency",
             .folder = "latency",
             .one_folder_each = false,
             .files = {"latency.csv"},
             .header = {"60 Hz tracker, 18 ms (PATRIOT)", "slip at 0.05 m/s", "at 0.25", "at 0.5", "at rest",
                        "overshoot, mean", "95th percentile"},
             .rows = latency_rows},
            {.name = "trembling",
             .folder = "latency",
             .one_folder_each = false,
             .files = {"latency.csv"},
             .header = {"slid at, mm/s", "2", "5", "15", "50", "150"},
             .rows = tremble_rows},
            hand_table(),
            {.name = "ladder",
             .folder = "ladder",
             .one_folder_each = false,
             .files = {"ladder_policies.csv"},
             .header = {"policy", "whole exhibit", "does not follow", "words for staff", "dark",
                        "longest dark", "reboots", "false alarms"},
             .rows = ladder_rows}};
}

std::vector<ReportTable> all_report_tables() {
    std::vector<ReportTable> tables = error_time_tables();
    for (const auto& more : {view_tables(), packless_tables(), part_tables()}) {
        tables.insert(tables.end(), more.begin(), more.end());
    }
    return tables;
}

} // namespace frustumscreen::bench
