#include "app/bench/torch/torch_bench.h"
#include "firmware_host/base/quantile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::bench {

namespace {

constexpr double max_cost = 1.25, max_cost_with_shadows = 1.6; ///< times the frame without a torch

const TorchRow* find(const std::vector<TorchRow>& rows, const std::string& scene,
                     const std::string& technique) {
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const TorchRow& row) {
        return row.scene == scene && row.way.name == technique;
    });
    return found != rows.end() ? &*found : nullptr;
}

std::vector<std::string> scenes_of(const TorchResult& result) {
    std::vector<std::string> scenes;
    for (const TorchRow& row : result.rows) {
        if (scenes.empty() || scenes.back() != row.scene) {
            scenes.push_back(row.scene);
        }
    }
    return scenes;
}

std::string line(bool held, const std::string& what) {
    return fmt::format("{} {}\n", held ? "held " : "unmet", what);
}

double median_of(const std::vector<std::size_t>& counts) {
    return quantile(std::vector<double>(counts.begin(), counts.end()), 0.5);
}

/// The spread in the paper's Fig. 4: of the mean times of groups of ten frames, the largest divided by the smallest.
double spread_of_tens(const std::vector<double>& frame_ms) {
    constexpr std::size_t ten = 10;
    double low = std::numeric_limits<double>::infinity();
    double high = 0.0;
    for (std::size_t first = 0; first + ten <= frame_ms.size(); first += ten) {
        double sum = 0.0;
        for (std::size_t k = 0; k < ten; ++k) {
            sum += frame_ms[first + k];
        }
        low = std::min(low, sum);
        high = std::max(high, sum);
    }
    return high > 0.0 ? high / low : 1.0;
}

struct Worst {
    double value = 0.0;
    std::string scene = "no scene";
    void take(double next, const std::string& of) {
        if (next >= value) {
            *this = {next, of};
        }
    }
};

struct Costs {
    Worst light, shadows;
    void take(const std::vector<TorchRow>& rows, const std::string& scene) {
        const TorchRow* const none = find(rows, scene, "none");
        if (none != nullptr) {
            const std::string where = fmt::format("{}, samples a pixel: {}", scene, none->way.samples);
            light.take(find(rows, scene, "ours_no_shadow")->ms_p50() / none->ms_p50(), where);
            shadows.take(find(rows, scene, "ours")->ms_p50() / none->ms_p50(), where);
        }
    }
    [[nodiscard]] std::string verdict() const {
        return line(light.value <= max_cost,
                    fmt::format("our light takes <= {:g} x the frame without a torch ({:.2f}; {})", max_cost,
                                light.value, light.scene)) +
               line(shadows.value <= max_cost_with_shadows,
                    fmt::format("with shadows <= {:g} x ({:.2f}; {})", max_cost_with_shadows, shadows.value,
                                shadows.scene));
    }
};

constexpr double as_little = 0.02; ///< per cent: what the picture's codes leave open

/// The cheapest of the paper's rows in a scene that errs no more than `row`; null: none.
const TorchRow* cheapest_paper(const TorchResult& result, const TorchRow& row) {
    const TorchRow* cheapest = nullptr;
    for (const TorchRow& each : result.rows) {
        if (each.scene == row.scene && each.way.kind == TorchWay::Kind::Paper &&
            each.error.rmse() <= row.error.rmse() + as_little &&
            (cheapest == nullptr || each.ms_p50() < cheapest->ms_p50())) {
            cheapest = &each;
        }
    }
    return cheapest;
}

} // namespace

std::string torch_csv(const TorchResult& result) {
    std::string csv = "scene,technique,tolerance_mm,ms_p50,ms_p99,intensity_rmse,intensity_max\n";
    for (const TorchRow& row : result.rows) {
        // Without a torch nothing is lit: there is no intensity to err.
        const bool lit = row.way.kind != TorchWay::Kind::None;
        csv += fmt::format("{},{},{:.4g},{:.3f},{:.3f},{:.4f},{:.4f}\n", row.scene, row.way.name,
                           row.tolerance_mm(), row.ms_p50(), row.ms_p99(), lit ? row.error.rmse() : 0.0,
                           lit ? row.error.max() : 0.0);
    }
    return csv;
}

std::string torch_samples_csv(const TorchResult& result) {
    std::string csv = "scene,technique,samples,ms_p50,ms_p99\n";
    for (const auto* const rows : {&result.rows, &result.samples}) {
        for (const TorchRow& row : *rows) {
            if (row.way.kind != TorchWay::Kind::Paper) {
                csv += fmt::format("{},{},{},{:.3f},{:.3f}\n", row.scene, row.way.name, row.way.samples,
                                   row.ms_p50(), row.ms_p99());
            }
        }
    }
    return csv;
}

std::string torch_frames_csv(const TorchResult& result) {
    std::string csv = "scene,technique,tolerance_mm,frame,ms,frame_tolerance_mm,triangles\n";
    for (const TorchRow& row : result.rows) {
        for (std::size_t frame = 0; frame < row.frame_ms.size(); ++frame) {
            const double tolerance_mm = row.tolerance_mm() > 0.0 ? 1e3 * row.way.tolerances[frame] : 0.0;
            csv +=
                fmt::format("{},{},{:.4g},{},{:.3f},{:.4g},{}\n", row.scene, row.way.name, row.tolerance_mm(),
                            frame, row.frame_ms[frame], tolerance_mm, row.triangles[frame]);
        }
    }
    return csv;
}

std::string torch_details_csv(const TorchResult& result) {
    std::string csv = "scene,technique,tolerance_mm,triangles_p50,lit_pixels,leak_pct,unclear_pct\n";
    for (const TorchRow& row : result.rows) {
        csv +=
            fmt::format("{},{},{:.4g},{:.0f},{},{:.3f},{:.2f}\n", row.scene, row.way.name, row.tolerance_mm(),
                        median_of(row.triangles), row.error.pixels(), row.error.leak(), row.error.unclear());
    }
    return csv;
}

std::string torch_table(const TorchResult& result) {
    std::string table =
        fmt::format("{:>7}{:>24}{:>8}{:>9}{:>9}{:>7}{:>9}{:>9}{:>11}{:>9}{:>10}\n", "scene", "technique",
                    "mm", "p50 ms", "p99 ms", "times", "rmse %", "max %", "triangles", "leak %", "unclear %");
    for (const TorchRow& row : result.rows) {
        const TorchRow* const none = find(result.rows, row.scene, "none");
        const bool lit = row.way.kind != TorchWay::Kind::None;
        table += fmt::format(
            "{:>7}{:>24}{:>8.3g}{:>9.2f}{:>9.2f}{:>7.2f}{:>9.3f}{:>9.3f}{:>11.0f}{:>9.2f}{:>10.1f}\n",
            row.scene, row.way.name, row.tolerance_mm(), row.ms_p50(), row.ms_p99(),
            row.ms_p50() / none->ms_p50(), lit ? row.error.rmse() : 0.0, lit ? row.error.max() : 0.0,
            median_of(row.triangles), row.error.leak(), row.error.unclear());
    }
    for (const TorchRow& row : result.samples) {
        const TorchRow* const none = find(result.samples, row.scene, "none");
        table += fmt::format("{:>7}{:>24}{:>8}{:>9.2f}{:>9.2f}{:>7.2f}  {} samples a pixel\n", row.scene,
                             row.way.name, "", row.ms_p50(), row.ms_p99(), row.ms_p50() / none->ms_p50(),
                             row.way.samples);
    }
    return table;
}

std::string torch_verdicts(const TorchResult& result) {
    Costs costs;
    Worst error;
    Worst leak;
    std::string of_paper;
    for (const std::string& scene : scenes_of(result)) {
        const TorchRow& ours = *find(result.rows, scene, "ours");
        const TorchRow& no_shadow = *find(result.rows, scene, "ours_no_shadow");
        costs.take(result.rows, scene);
        costs.take(result.samples, scene);
        error.take(ours.error.max(), scene);
        leak.take(ours.error.leak(), scene);
        const TorchRow* const paper = cheapest_paper(result, no_shadow);
        of_paper += paper == nullptr
                        ? line(true, fmt::format("{}: no row of the paper errs as little as ours", scene))
                        : line(no_shadow.ms_p50() <= paper->ms_p50(),
                               fmt::format("{}: ours is no dearer than the paper at its error ({:.2f} ms; {} "
                                           "{:.2f} ms)",
                                           scene, no_shadow.ms_p50(), paper->way.name, paper->ms_p50()));
        const double steered = spread_of_tens(find(result.rows, scene, "paper_steered")->frame_ms);
        const double fixed = spread_of_tens(find(result.rows, scene, "paper_fixed")->frame_ms);
        of_paper +=
            line(steered <= fixed,
                 fmt::format("{}: the paper's steered tolerance spreads its frame time less than a fixed "
                             "one ({:.2f} times; {:.2f}; ours {:.2f})",
                             scene, steered, fixed, spread_of_tens(no_shadow.frame_ms)));
    }
    return costs.verdict() +
           line(error.value <= 1.0, fmt::format("our intensity errs by <= 1 % at every pixel ({:.2f} %, {})",
                                                error.value, error.scene)) +
           line(leak.value <= 0.1, fmt::format("no light in shadow, <= 0.1 % of its pixels ({:.2f} %, {})",
                                               leak.value, leak.scene)) +
           of_paper;
}

} // namespace frustumscreen::bench
