#include "app/bench/ldi/ldi_bench.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::bench {

namespace {

const LdiRow* find(const LdiResult& result, std::size_t triangles, const std::string& technique) {
    const auto found = std::find_if(result.rows.begin(), result.rows.end(), [&](const LdiRow& row) {
        return row.triangles == triangles && row.technique == technique;
    });
    return found != result.rows.end() ? &*found : nullptr;
}

std::string line(bool held, const std::string& what) {
    return fmt::format("{} {}\n", held ? "held " : "unmet", what);
}

} // namespace

std::string ldi_csv(const LdiResult& result) {
    std::string csv =
        "triangles,windows,technique,ms_p50,ms_p99,silhouette_pct,error_mm_mean,rmse,mb,make_ms\n";
    for (const LdiRow& row : result.rows) {
        for (std::size_t windows = 0; windows < row.frame_ms.size(); ++windows) {
            // The scene alone has no window: nothing can err or is made.
            const LdiError error = windows > 0 ? row.error : LdiError{};
            csv += fmt::format("{},{},{},{:.3f},{:.3f},{:.4f},{:.4f},{:.3f},{:.3f},{:.1f}\n", row.triangles,
                               windows, row.technique, row.ms_p50(windows), row.ms_p99(windows),
                               error.silhouette_pct, error.error_mm, error.rmse, windows > 0 ? row.mb : 0.0,
                               windows > 0 ? row.make_ms : 0.0);
        }
    }
    return csv;
}

std::string ldi_error_csv(const LdiResult& result) {
    std::string csv = "triangles,technique,pixels,patch,pictures,silhouette_pct,error_mm_mean,rmse\n";
    for (const LdiPatchRow& row : result.by_patch) {
        csv += fmt::format("{},{},{},{},{},{:.4f},{:.4f},{:.3f}\n", row.triangles, row.technique, row.pixels,
                           row.patch, row.error.pictures, row.error.silhouette_pct, row.error.error_mm,
                           row.error.rmse);
    }
    return csv;
}

std::string ldi_table(const LdiResult& result) {
    std::string table = fmt::format("{:>10}{:>17}{:>10}{:>10}{:>10}{:>9}{:>9}{:>9}{:>8}{:>9}{:>9}\n",
                                    "triangles", "technique", "alone ms", "4 win. ms", "a win. ms", "cheaper",
                                    "silh. %", "error mm", "rmse", "MB", "make ms");
    for (const LdiRow& row : result.rows) {
        const LdiRow* const geometry = find(result, row.triangles, "geometry");
        table += fmt::format(
            "{:>10}{:>17}{:>10.2f}{:>10.2f}{:>10.3f}{:>9.1f}{:>9.3f}{:>9.4f}{:>8.2f}{:>9.2f}{:>9.0f}\n",
            row.triangles, row.technique, row.ms_p50(0), row.ms_p50(max_windows), row.window_ms(),
            geometry->window_ms() / row.window_ms(), row.error.silhouette_pct, row.error.error_mm,
            row.error.rmse, row.mb, row.make_ms);
    }
    return table;
}

std::string ldi_verdicts(const LdiResult& result) {
    constexpr double min_cheaper = 60.0;
    constexpr double max_silhouette_pct = 1.0;
    constexpr double max_make_ms = 3000.0;
    const std::size_t triangles =
        std::max_element(result.rows.begin(), result.rows.end(), [](const LdiRow& a, const LdiRow& b) {
            return a.triangles < b.triangles;
        })->triangles;
    const LdiRow* const geometry = find(result, triangles, "geometry");
    std::string verdicts;
    for (const char* const name : {"ours", "multi_ldi_paper"}) {
        const LdiRow* const row = find(result, triangles, name);
        if (row == nullptr) {
            continue;
        }
        const double cheaper = geometry->window_ms() / row->window_ms();
        verdicts +=
            line(cheaper >= min_cheaper,
                 fmt::format("{}: a window more is >= {:g} x cheaper than geometry ({:.1f} x)", name,
                             min_cheaper, cheaper)) +
            line(row->error.silhouette_pct <= max_silhouette_pct,
                 fmt::format("{}: silhouette <= {:g} % ({:.2f} %)", name, max_silhouette_pct,
                             row->error.silhouette_pct)) +
            line(row->make_ms <= max_make_ms, fmt::format("{}: made within {:g} ms on one core ({:.0f} ms)",
                                                          name, max_make_ms, row->make_ms));
    }
    return verdicts;
}

} // namespace frustumscreen::bench
