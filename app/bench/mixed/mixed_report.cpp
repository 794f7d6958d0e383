#include "app/bench/mixed/mixed.h"
#include "firmware_host/base/quantile.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::bench {

double MixedRow::ms_p50() const {
    return quantile(frame_ms, 0.5);
}
double MixedRow::ms_p99() const {
    return quantile(frame_ms, 0.99);
}
double MixedRow::max_pop_codes() const {
    return pop_codes.empty() ? 0.0 : *std::max_element(pop_codes.begin(), pop_codes.end());
}

std::string mixed_csv(const MixedResult& result) {
    std::string csv = "technique,budget_us,ms_p50,ms_p99,error_mm_mean,silhouette_pct,switches,pop_codes\n";
    for (const MixedRow& row : result.rows) {
        csv += fmt::format("{},{:.0f},{:.3f},{:.3f},{:.5f},{:.4f},{},{:.3f}\n", row.technique, row.budget_us,
                           row.ms_p50(), row.ms_p99(), row.error_mm_mean, row.silhouette_percent,
                           row.switches, row.max_pop_codes());
    }
    return csv;
}

std::string mixed_frames_csv(const MixedResult& result) {
    std::string csv = "technique,budget_us,frame,ms,pop_codes\n";
    for (const MixedRow& row : result.rows) {
        for (std::size_t frame = 0; frame < row.frame_ms.size(); ++frame) {
            const double pop = frame > 0 && frame <= row.pop_codes.size() ? row.pop_codes[frame - 1] : 0.0;
            csv += fmt::format("{},{:.0f},{},{:.3f},{:.3f}\n", row.technique, row.budget_us, frame,
                               row.frame_ms[frame], pop);
        }
    }
    return csv;
}

std::string mixed_table(const MixedResult& result) {
    std::string table =
        fmt::format("{} cells; the paper's weights: u {:g}, v {:g}, w {:g}, x {:g}\n", result.cells,
                    result.weights.u, result.weights.v, result.weights.w, result.weights.x);
    table += fmt::format("{:>10}{:>10}{:>9}{:>9}{:>10}{:>13}{:>10}{:>9}\n", "budget us", "technique",
                         "p50 ms", "p99 ms", "error mm", "silhouette %", "switches", "popping");
    for (const MixedRow& row : result.rows) {
        table += fmt::format("{:>10.0f}{:>10}{:>9.2f}{:>9.2f}{:>10.4f}{:>13.3f}{:>10}{:>9.2f}\n",
                             row.budget_us, row.technique, row.ms_p50(), row.ms_p99(), row.error_mm_mean,
                             row.silhouette_percent, row.switches, row.max_pop_codes());
    }
    return table;
}

std::string mixed_verdicts(const MixedResult& result) {
    std::string lines;
    for (std::size_t k = 0; k + 1 < result.rows.size(); k += 2) {
        const MixedRow& ours = result.rows[k];
        const MixedRow& paper = result.rows[k + 1];
        const auto word = [](bool held) { return held ? "held " : "unmet"; };
        lines +=
            fmt::format("{} at {:.0f} us ours keeps the budget ({:.0f} us)\n",
                        word(1e3 * ours.ms_p99() <= ours.budget_us), ours.budget_us, 1e3 * ours.ms_p99());
        lines +=
            fmt::format("{} at {:.0f} us ours has the smaller error ({:.4f} mm; the paper's {:.4f} mm)\n",
                        word(ours.error_mm_mean <= paper.error_mm_mean), ours.budget_us, ours.error_mm_mean,
                        paper.error_mm_mean);
        lines += fmt::format("{} at {:.0f} us ours pops less ({:.2f} codes; the paper's {:.2f})\n",
                             word(ours.max_pop_codes() <= paper.max_pop_codes()), ours.budget_us,
                             ours.max_pop_codes(), paper.max_pop_codes());
    }
    return lines;
}

} // namespace frustumscreen::bench
