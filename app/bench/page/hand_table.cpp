#include "app/bench/page/report_tables.h"
#include "app/bench/page/table_cells.h"

#include <array>

namespace frustumscreen::bench {

namespace {

struct Column {
    const char* filter_name;
    const char* where;
    const char* field;
};
constexpr std::array columns = {Column{"for the table", "hand", "slip_mean_mm"},
                                Column{"constant velocity", "hand", "slip_mean_mm"},
                                Column{"exhibit, as shown", "hand", "slip_mean_mm"},
                                Column{"best weights", "hand", "slip_mean_mm"},
                                Column{"for the table", "hand", "overshoot_mean_mm"},
                                Column{"constant velocity", "hand", "overshoot_mean_mm"},
                                Column{"exhibit, as shown", "hand", "overshoot_mean_mm"},
                                Column{"for the table", "table", "slip_mean_mm"},
                                Column{"exhibit, as shown", "table", "slip_mean_mm"}};

/// One figure of a replay, in mm; empty if it was not measured.
Result<std::string> replayed_mm(const CsvTable& table, std::vector<std::size_t> rows, const Column& column) {
    TRY(rows, rows_with(table, rows, "contestant", column.filter_name));
    TRY(rows, rows_with(table, rows, "where", column.where));
    if (rows.empty()) {
        return std::string();
    }
    TRY(const double mm, table.number(rows.front(), column.field));
    return decimals(mm, 2);
}

/// "vicon_handheld_1.csv" is Vicon's, the other one TUM's.
std::string name_of_recording(const std::string& file) {
    return file.starts_with("vicon") ? "Vicon" : "TUM fr1/xyz";
}

Result<TableCells> hand_rows(std::span<const MeasuredRun> runs) {
    const CsvTable& table = runs.front().files[0];
    TableCells rows;
    for (const char* tracker : {"Polhemus PATRIOT", "Polhemus VIPER"}) {
        for (const char* recording : {"vicon_handheld_1.csv", "tum_fr1_xyz_groundtruth.txt"}) {
            for (const char* times : {"1", "2", "4"}) {
                TRY(std::vector<std::size_t> own, rows_with(table, "tracker", tracker));
                TRY(own, rows_with(table, own, "recording", recording));
                TRY(own, rows_with(table, own, "times", times));
                if (own.empty()) {
                    continue;
                }
                rows.push_back({fmt::format("{}, {}", tracker, name_of_recording(recording)), times});
                for (const Column& column : columns) {
                    TRY(std::string cell, replayed_mm(table, own, column));
                    rows.back().push_back(std::move(cell));
                }
            }
        }
    }
    return rows;
}

} // namespace

ReportTable hand_table() {
    return {.name = "hand",
            .folder = "latency",
            .one_folder_each = false,
            .files = {"latency_hand.csv"},
            .header = {"tracker, recording", "speed", "slip: for the table", "constant velocity", "exhibit",
                       "best weights", "overshoot: for the table", "constant velocity", "exhibit",
                       "slid, slip: for the table", "exhibit"},
            .rows = hand_rows};
}

} // namespace frustumscreen::bench
