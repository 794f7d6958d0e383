#include "app/bench/page/report_tables.h"
#include "app/bench/page/table_cells.h"

#include <algorithm>
#include <optional>

namespace frustumscreen::bench {

namespace {

constexpr const char* near_set_up = "near";
constexpr const char* shipped_set_up = "kiosk"; // config/kiosk.toml
constexpr std::string_view default_mesh = "default mesh";

/// A row of error_time.csv.
struct DrawnRow {
    std::size_t row = 0;
    std::string technique, kind;
};

Result<std::vector<DrawnRow>> drawn_in(const CsvTable& table, std::string_view set_up) {
    std::vector<DrawnRow> drawn;
    TRY(const std::vector<std::size_t> rows, rows_with(table, "set_up", set_up));
    for (const std::size_t row : rows) {
        TRY(std::string technique, table.text(row, "technique"));
        TRY(std::string kind, table.text(row, "kind"));
        drawn.push_back({row, std::move(technique), std::move(kind)});
    }
    return drawn;
}

/// Whether a row is what a page's table calls `drawn_as`.
bool is_drawn_as(const DrawnRow& row, std::string_view drawn_as) {
    return drawn_as == default_mesh ? row.kind == "pack level" && row.technique.ends_with("(default)")
                                    : row.kind == "pack relief" && row.technique == drawn_as;
}

std::optional<DrawnRow> row_drawn_as(const std::vector<DrawnRow>& drawn, std::string_view drawn_as) {
    const auto found = std::find_if(drawn.begin(), drawn.end(),
                                    [&](const DrawnRow& row) { return is_drawn_as(row, drawn_as); });
    return found != drawn.end() ? std::optional(*found) : std::nullopt;
}

/// Cost and errors of a row, as the tables of a frame have them.
Result<std::vector<std::string>> frame_cells(const CsvTable& table, std::size_t row) {
    TRY(const double cost, table.number(row, "cpu_times_floor"));
    std::vector<std::string> cells = {cost_cell(cost)};
    for (const char* column : {"mean_outline_shift_px", "worst_outline_shift_px", "mean_geometric_mean_mm",
                               "worst_geometric_mean_mm"}) {
        TRY(const double error, table.number(row, column));
        cells.push_back(decimals(error, 3));
    }
    return cells;
}

Result<TableCells> frame_rows(std::span<const MeasuredRun> runs, std::string_view set_up,
                              std::span<const std::string_view> drawn_as) {
    TableCells rows;
    for (const MeasuredRun& run : runs) {
        TRY(const std::vector<DrawnRow> drawn, drawn_in(run.files[0], set_up));
        for (const std::string_view wanted : drawn_as) {
            if (const std::optional<DrawnRow> row = row_drawn_as(drawn, wanted)) {
                TRY(const std::vector<std::string> figures, frame_cells(run.files[0], row->row));
                rows.push_back({run.name, std::string(wanted)});
                rows.back().insert(rows.back().end(), figures.begin(), figures.end());
            }
        }
    }
    return rows;
}

ReportTable frame_table(const std::string& name, const char* folder, const char* set_up,
                        std::vector<std::string_view> drawn_as) {
    return {.name = name,
            .folder = folder,
            .one_folder_each = true,
            .files = {"error_time.csv"},
            .header = {"model", "drawn as", "x floor", "outline px, mean", "worst", "mm, mean", "worst"},
            .rows = [set_up, drawn_as = std::move(drawn_as)](std::span<const MeasuredRun> runs) {
                return frame_rows(runs, set_up, drawn_as);
            }};
}

/// "49 of 50": the poses in which relief384 is a fine picture.
Result<std::string> fine_poses(const CsvTable& poses, std::string_view set_up) {
    constexpr double fine_mm = 0.05, fine_px = 0.1, fine_percent = 0.15;
    TRY(std::vector<std::size_t> rows, rows_with(poses, "set_up", set_up));
    TRY(rows, rows_with(poses, rows, "technique", "relief384"));
    std::size_t fine = 0;
    for (const std::size_t row : rows) {
        TRY(const double mm, poses.number(row, "geometric_mean_mm"));
        TRY(const double px, poses.number(row, "outline_shift_px"));
        TRY(const double percent, poses.number(row, "silhouette_percent"));
        fine += mm <= fine_mm && (px <= fine_px || percent <= fine_percent) ? 1 : 0;
    }
    return rows.empty() ? std::string() : fmt::format("{} of {}", fine, rows.size());
}

Result<TableCells> fine_pose_rows(std::span<const MeasuredRun> runs) {
    TableCells rows;
    for (const MeasuredRun& run : runs) {
        TRY(const std::string close, fine_poses(run.files[0], near_set_up));
        TRY(const std::string shipped, fine_poses(run.files[0], shipped_set_up));
        if (!close.empty() || !shipped.empty()) {
            rows.push_back({run.name, close, shipped});
        }
    }
    return rows;
}

/// The worst of each figure over the poses of both set-ups.
struct WorstShown {
    double cover_beyond_samples_px = 0.0;
    double shift_px = 0.0;
    double rmse = 0.0;
};

Result<WorstShown> worst_shown(const CsvTable& poses, const std::string& technique) {
    WorstShown worst;
    TRY(const std::vector<std::size_t> rows, rows_with(poses, "technique", technique));
    for (const std::size_t row : rows) {
        TRY(const double cover, poses.number(row, "shown_cover_px"));
        TRY(const double samples, poses.number(row, "shown_cover_of_samples_px"));
        TRY(const double shift, poses.number(row, "shown_shift_px"));
        TRY(const double rmse, poses.number(row, "shown_rmse"));
        worst.cover_beyond_samples_px = std::max(worst.cover_beyond_samples_px, cover - samples);
        worst.shift_px = std::max(worst.shift_px, shift);
        worst.rmse = std::max(worst.rmse, rmse);
    }
    return worst;
}

Result<TableCells> shown_rows(std::span<const MeasuredRun> runs) {
    TableCells rows;
    for (const MeasuredRun& run : runs) {
        TRY(std::vector<DrawnRow> drawn, drawn_in(run.files[0], near_set_up));
        TRY(const std::vector<DrawnRow> shipped, drawn_in(run.files[0], shipped_set_up));
        drawn.insert(drawn.end(), shipped.begin(), shipped.end());
        for (const std::string_view wanted : {default_mesh, std::string_view("relief384")}) {
            if (const std::optional<DrawnRow> row = row_drawn_as(drawn, wanted)) {
                TRY(const double samples, run.files[0].number(row->row, "samples"));
                TRY(const WorstShown worst, worst_shown(run.files[1], row->technique));
                rows.push_back({run.name, std::string(wanted), decimals(samples, 0),
                                decimals(worst.cover_beyond_samples_px, 3), decimals(worst.shift_px, 3),
                                decimals(worst.rmse, 1)});
            }
        }
    }
    return rows;
}

/// The figures by which peers are compared.
struct PeerFigures {
    double samples = 0.0;
    double cost = 0.0;
    double silhouette_percent = 0.0;
    double geometric_mm = 0.0;
};

Result<PeerFigures> peer_figures(const CsvTable& table, std::size_t row) {
    PeerFigures figures;
    TRY(figures.samples, table.number(row, "samples"));
    TRY(figures.cost, table.number(row, "cpu_times_floor"));
    TRY(figures.silhouette_percent, table.number(row, "mean_silhouette_percent"));
    TRY(figures.geometric_mm, table.number(row, "mean_geometric_mean_mm"));
    return figures;
}

/// The cheapest peer of a kind with as many samples as `ours`; `as_good`: it errs by 5 % more at most.
Result<std::string> cheapest_peer(const CsvTable& table, const std::vector<DrawnRow>& drawn,
                                  std::string_view kind, const PeerFigures& ours, bool as_good) {
    constexpr double tolerance = 1.05;
    std::optional<double> cheapest;
    for (const DrawnRow& row : drawn) {
        if (row.kind != kind) {
            continue;
        }
        TRY(const PeerFigures peer, peer_figures(table, row.row));
        const bool good = peer.silhouette_percent <= tolerance * ours.silhouette_percent &&
                          peer.geometric_mm <= tolerance * ours.geometric_mm;
        if (peer.samples == ours.samples && (good || !as_good)) {
            cheapest = std::min(cheapest.value_or(peer.cost), peer.cost);
        }
    }
    return cheapest ? cost_cell(*cheapest) : std::string(as_good ? "none as good" : "");
}

Result<TableCells> peer_rows(std::span<const MeasuredRun> runs) {
    TableCells rows;
    for (const MeasuredRun& run : runs) {
        const CsvTable& table = run.files[0];
        TRY(const std::vector<DrawnRow> drawn, drawn_in(table, shipped_set_up));
        const std::optional<DrawnRow> mesh = row_drawn_as(drawn, default_mesh);
        if (!mesh) {
            continue;
        }
        TRY(const PeerFigures ours, peer_figures(table, mesh->row));
        std::string relief_cost;
        if (const std::optional<DrawnRow> relief = row_drawn_as(drawn, "relief384")) {
            TRY(const double cost, table.number(relief->row, "cpu_times_floor"));
            relief_cost = cost_cell(cost);
        }
        TRY(const std::string lod, cheapest_peer(table, drawn, "LOD", ours, true));
        TRY(const std::string ray_cast, cheapest_peer(table, drawn, "ray cast", ours, false));
        rows.push_back(
            {run.name, decimals(ours.samples, 0), cost_cell(ours.cost), relief_cost, lod, ray_cast});
    }
    return rows;
}

} // namespace

std::vector<ReportTable> error_time_tables() {
    const std::vector<std::string_view> shipped_reliefs = {default_mesh, "relief192", "relief384"};
    return {
        frame_table("cost_shipped", "lit", shipped_set_up, shipped_reliefs),
        frame_table("cost_near", "lit", near_set_up, shipped_reliefs),
        {.name = "relief_poses",
         .folder = "lit",
         .one_folder_each = true,
         .files = {"error_time_poses.csv"},
         .header = {"model", "near", "shipped"},
         .rows = fine_pose_rows},
        frame_table("relief768", "size1024", shipped_set_up, {"relief768"}),
        {.name = "as_shown",
         .folder = "shown",
         .one_folder_each = true,
         .files = {"error_time.csv", "error_time_poses.csv"},
         .header = {"model", "drawn as", "samples", "cover beyond samples, px", "shift, px", "RMSE, codes"},
         .rows = shown_rows},
        {.name = "peers",
         .folder = "peers",
         .one_folder_each = true,
         .files = {"error_time.csv"},
         .header = {"model", "samples", "default mesh, x floor", "relief384", "meshoptimizer", "ray cast"},
         .rows = peer_rows}};
}

} // namespace frustumscreen::bench
