#include "app/bench/page/report_tables.h"
#include "app/bench/page/table_cells.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <utility>

namespace frustumscreen::bench {

namespace {

constexpr const char* shipped_set_up = "kiosk"; // config/kiosk.toml

/// The number of a mesh level in its name, "mesh 3 (default)"; -1: no mesh level.
int level_in(std::string_view technique) {
    constexpr std::string_view word = "mesh ";
    int level = -1;
    if (technique.starts_with(word)) {
        std::from_chars(technique.data() + word.size(), technique.data() + technique.size(), level);
    }
    return level;
}

/// Poses and how many of them an estimate covers.
struct CoveredPoses {
    double covered = 0.0;
    double poses = 0.0;
};

/// The kinds of picture that are estimated, in the words and order of the table.
constexpr std::array<const char*, 4> estimated_words = {"levels but the finest", "finest levels",
                                                        "what `auto` draws", "reliefs"};
using CoveredOfKind = std::array<CoveredPoses, estimated_words.size()>;

std::size_t estimated_kind(std::string_view level, int finest_level) {
    if (level.starts_with("auto")) {
        return 2;
    }
    if (level.starts_with("relief")) {
        return 3;
    }
    return level_in(level) == finest_level ? 1 : 0;
}

/// The finest mesh level of each artifact in the table.
Result<std::map<std::string, int>> finest_levels(const CsvTable& table) {
    std::map<std::string, int> finest;
    for (std::size_t row = 0; row < table.size(); ++row) {
        TRY(const std::string artifact, table.text(row, "artifact"));
        TRY(const std::string level, table.text(row, "level"));
        int& known = finest.try_emplace(artifact, -1).first->second;
        known = std::max(known, level_in(level));
    }
    return finest;
}

Result<CoveredOfKind> covered_in(const CsvTable& table) {
    TRY(const auto finest, finest_levels(table));
    CoveredOfKind kinds{};
    for (std::size_t row = 0; row < table.size(); ++row) {
        TRY(const std::string artifact, table.text(row, "artifact"));
        TRY(const std::string level, table.text(row, "level"));
        TRY(const double covered, table.number(row, "covered"));
        TRY(const double poses, table.number(row, "poses"));
        CoveredPoses& kind = kinds.at(estimated_kind(level, finest.at(artifact)));
        kind.covered += covered;
        kind.poses += poses;
    }
    return kinds;
}

Result<TableCells> estimate_rows(std::span<const MeasuredRun> runs) {
    TableCells rows;
    for (const MeasuredRun& run : runs) {
        TRY(const CoveredOfKind kinds, covered_in(run.files[0]));
        for (std::size_t k = 0; k < kinds.size(); ++k) {
            if (kinds.at(k).poses > 0.0) {
                rows.push_back({run.name, estimated_words.at(k), decimals(kinds.at(k).covered, 0),
                                decimals(kinds.at(k).poses, 0)});
            }
        }
    }
    return rows;
}

/// The default and the finest mesh level in the shipped set-up; empty: there is none.
struct MeshNames {
    std::string standard, finest;
};

Result<MeshNames> mesh_names(const CsvTable& table, const std::vector<std::size_t>& rows) {
    MeshNames names;
    for (const std::size_t row : rows) {
        TRY(const std::string technique, table.text(row, "technique"));
        if (technique.ends_with("(default)")) {
            names.standard = technique;
        }
        if (level_in(technique) > level_in(names.finest)) {
            names.finest = technique;
        }
    }
    return names;
}

/// Mean and least of the right pixels, in per cent; empty cells if the technique was not drawn.
Result<std::array<std::string, 2>> right_cells(const CsvTable& table, const std::vector<std::size_t>& rows,
                                               std::string_view technique) {
    TRY(const std::vector<std::size_t> own, rows_with(table, rows, "technique", technique));
    TRY(const std::vector<double> right, numbers_in(table, own, "right_16_rays_percent"));
    if (right.empty()) {
        return std::array<std::string, 2>{};
    }
    return std::array{decimals(mean_of(right), 2),
                      decimals(*std::min_element(right.begin(), right.end()), 2)};
}

/// The part of one model's table that belongs to the shipped set-up.
struct ShippedRows {
    const CsvTable& table;
    std::vector<std::size_t> rows;
    MeshNames names;
};

/// A row for each model with a default level in the shipped set-up: its name, and the cells of `cells_of`.
template <typename CellsOf>
Result<TableCells> shipped_rows(std::span<const MeasuredRun> runs, CellsOf cells_of) {
    TableCells rows;
    for (const MeasuredRun& run : runs) {
        const CsvTable& table = run.files[0];
        TRY(std::vector<std::size_t> own, rows_with(table, "set_up", shipped_set_up));
        TRY(MeshNames names, mesh_names(table, own));
        if (names.standard.empty()) {
            continue;
        }
        TRY(std::vector<std::string> cells,
            cells_of(ShippedRows{.table = table, .rows = std::move(own), .names = std::move(names)}));
        cells.insert(cells.begin(), run.name);
        rows.push_back(std::move(cells));
    }
    return rows;
}

Result<std::vector<std::string>> projection_cells(const ShippedRows& shipped) {
    TRY(const auto drawn, right_cells(shipped.table, shipped.rows, shipped.names.standard));
    TRY(const auto cast, right_cells(shipped.table, shipped.rows, "ray-cast picture"));
    return std::vector<std::string>{drawn[0], drawn[1], cast[0], cast[1]};
}

/// The mean of a column over a technique's sequences; empty if it has none.
Result<std::string> sequence_mean(const CsvTable& table, const std::vector<std::size_t>& rows,
                                  std::string_view technique, std::string_view column) {
    TRY(const std::vector<std::size_t> own, rows_with(table, rows, "technique", technique));
    TRY(const std::vector<double> numbers, numbers_in(table, own, column));
    return numbers.empty() ? std::string() : decimals(mean_of(numbers), 2);
}

Result<std::vector<std::string>> shimmer_cells(const ShippedRows& shipped) {
    const auto& [standard, finest] = shipped.names;
    std::vector<std::string> cells;
    for (const auto& [technique, column] :
         {std::pair{&standard, "rms"}, std::pair{&finest, "rms"}, std::pair{&finest, "rms_1_ray"},
          std::pair{&finest, "rms_16_rays"}}) {
        TRY(std::string cell, sequence_mean(shipped.table, shipped.rows, *technique, column));
        cells.push_back(std::move(cell));
    }
    return cells;
}

Result<TableCells> projection_rows(std::span<const MeasuredRun> runs) {
    return shipped_rows(runs, projection_cells);
}

Result<TableCells> shimmer_rows(std::span<const MeasuredRun> runs) {
    return shipped_rows(runs, shimmer_cells);
}

/// RMS of all changes in `rows`, each of which has the RMS of its own.
Result<std::string> changes_rms(const CsvTable& table, const std::vector<std::size_t>& rows) {
    double changes = 0.0;
    double squares = 0.0;
    for (const std::size_t row : rows) {
        TRY(const double count, table.number(row, "changes"));
        TRY(const double rms, table.number(row, "rms"));
        changes += count;
        squares += count * rms * rms;
    }
    return changes > 0.0 ? decimals(std::sqrt(squares / changes), 1) : std::string();
}

Result<TableCells> edge_rows(std::span<const MeasuredRun> runs) {
    TableCells rows;
    for (const auto& [set_up, name] : {std::pair{shipped_set_up, "shipped"}, std::pair{"near", "near"}}) {
        for (const MeasuredRun& run : runs) {
            const CsvTable& table = run.files[0];
            TRY(const std::vector<std::size_t> own, rows_with(table, "set_up", set_up));
            if (own.empty()) {
                continue;
            }
            rows.push_back({name, run.name});
            for (const auto& [pixels, edges] :
                 {std::pair{"shared", "sharp"}, std::pair{"shared", "feathered"},
                  std::pair{"beside", "sharp"}}) {
                TRY(std::vector<std::size_t> those, rows_with(table, own, "pixels", pixels));
                TRY(those, rows_with(table, those, "edges", edges));
                TRY(std::string cell, changes_rms(table, those));
                rows.back().push_back(std::move(cell));
            }
        }
    }
    return rows;
}

} // namespace

std::vector<ReportTable> view_tables() {
    return {{.name = "estimate",
             .folder = "estimate",
             .one_folder_each = true,
             .files = {"estimate.csv"},
             .header = {"scans", "drawn", "covered poses", "of"},
             .rows = estimate_rows},
            {.name = "edges",
             .folder = "shimmer",
             .one_folder_each = true,
             .files = {"edge_sparkle.csv"},
             .header = {"set-up", "model", "sharp edges", "soft edges", "beside the edges"},
             .rows = edge_rows},
            {.name = "projection",
             .folder = "projection",
             .one_folder_each = true,
             .files = {"projection.csv"},
             .header = {"model", "default, mean", "default, worst", "ray-cast picture, mean",
                        "ray-cast picture, worst"},
             .rows = projection_rows},
            {.name = "shimmer",
             .folder = "shimmer",
             .one_folder_each = true,
             .files = {"shimmer.csv"},
             .header = {"model", "default", "finest", "ray cast, 1 ray", "ray cast, 16 rays"},
             .rows = shimmer_rows}};
}

} // namespace frustumscreen::bench
