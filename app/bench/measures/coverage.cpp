#include "app/bench/measures/coverage.h"

#include "app/bench/measures/comparison.h"
#include "app/bench/truth/csv_fields.h"

#include <fmt/format.h>

#include <numeric>

namespace frustumscreen::bench {

Coverage coverage_of(const TechniqueResult& technique) {
    Coverage coverage;
    std::vector<double> ratios;
    for (std::size_t k = 0; k < technique.estimates.size(); ++k) {
        const std::optional<scene::ErrorEstimate>& estimate = technique.estimates[k];
        const PictureError& error = technique.errors[k];
        if (!estimate || error.truth_pixels == 0) {
            continue;
        }
        const double ratio = error.geometric_mean_mm / estimate->mean_mm;
        const bool below = error.geometric_mean_mm < estimate->p95_mm;
        coverage.below_p95 += below ? 1 : 0;
        coverage.covered += below && ratio >= min_of_estimate && ratio <= max_of_estimate ? 1 : 0;
        ratios.push_back(ratio);
    }
    coverage.poses = ratios.size();
    coverage.ratio = spread_of(ratios);
    return coverage;
}

Result<SetUpResult> measure_estimates(const SetUp& set_up, const pack::Pack& pack,
                                      const std::shared_ptr<const bake::SourceMesh>& mesh,
                                      const EstimateOptions& options, const StepProgress& progress) {
    const std::string step = set_up.name + ": estimates";
    progress(step, 0.0);
    std::vector<std::uint32_t> levels(pack.levels.size());
    std::iota(levels.begin(), levels.end(), 0U);
    TRY(Comparison opened, at(set_up.name, open_comparison(set_up, pack, levels, mesh,
                                                           {PictureOptions{}, options.poses, options.seed})));
    TechniqueSet& set = *opened.set;
    const Result<void> measured =
        set.add_auto(pack, {}).and_then([&] { return set.add_reliefs(pack, {}); }).and_then([&] {
            return set.measure_shape(opened.truth, opened.poses, options.rays,
                                     [&](double done) { progress(step, done); });
        });
    TRY_VOID(at(set_up.name, measured));
    SetUpResult result{.name = set_up.name,
                       .driver = set.driver(),
                       .default_level = pack.default_level,
                       .finest_level = levels.back(),
                       .baked_light = !pack.unlit,
                       .poses = {},
                       .techniques = set.results(),
                       .worst = {}};
    result.poses = std::move(opened.poses);
    return result;
}

std::vector<NamedCoverage> coverages_of(const std::string& artifact, const SetUpResult& result) {
    std::vector<NamedCoverage> rows;
    for (const TechniqueResult& technique : result.techniques) {
        if (const Coverage coverage = coverage_of(technique); coverage.poses > 0) {
            rows.push_back(
                {.artifact = artifact, .set_up = result.name, .level = technique.name, .coverage = coverage});
        }
    }
    return rows;
}

std::string coverage_table(std::span<const NamedCoverage> rows) {
    std::string table = fmt::format("{:<26}{:<9}{:<24}{:>7}{:>9}{:>11}  {}\n", "artifact", "set-up", "level",
                                    "poses", "covered", "below p95", "truth / estimate: p10, median, p90");
    for (const NamedCoverage& row : rows) {
        const Coverage& c = row.coverage;
        table +=
            fmt::format("{:<26}{:<9}{:<24}{:>7}{:>9}{:>11}  {:.2f} {:.2f} {:.2f}\n", row.artifact, row.set_up,
                        row.level, c.poses, c.covered, c.below_p95, c.ratio.p10, c.ratio.median, c.ratio.p90);
    }
    return table;
}

std::string coverage_csv(std::span<const NamedCoverage> rows) {
    std::string csv = "artifact,set_up,level,poses,covered,below_p95,ratio_p10,ratio_median,ratio_p90\n";
    for (const NamedCoverage& row : rows) {
        const Coverage& c = row.coverage;
        csv += fmt::format("{},{},{},{},{},{},{:.4f},{:.4f},{:.4f}\n", quoted(row.artifact),
                           quoted(row.set_up), quoted(row.level), c.poses, c.covered, c.below_p95,
                           c.ratio.p10, c.ratio.median, c.ratio.p90);
    }
    return csv;
}

std::string estimates_csv(const std::string& artifact, const SetUpResult& result) {
    std::string csv;
    for (const TechniqueResult& technique : result.techniques) {
        for (std::size_t k = 0; k < technique.estimates.size(); ++k) {
            if (const std::optional<scene::ErrorEstimate>& estimate = technique.estimates[k]) {
                const PictureError& error = technique.errors[k];
                csv += fmt::format("{},{},{},{},{:.6f},{:.6f},{:.6f},{:.6f},{}\n", quoted(artifact),
                                   quoted(result.name), quoted(technique.name), k, error.geometric_mean_mm,
                                   error.geometric_p95_mm, estimate->mean_mm, estimate->p95_mm,
                                   error.truth_pixels);
            }
        }
    }
    return csv;
}

LimitVerdict judge(std::span<const NamedCoverage> rows) {
    std::size_t poses = 0;
    std::size_t covered = 0;
    for (const NamedCoverage& row : rows) {
        poses += row.coverage.poses;
        covered += row.coverage.covered;
    }
    const double share = poses > 0 ? static_cast<double>(covered) / static_cast<double>(poses) : 0.0;
    return {
        .what = fmt::format(
            "true mean error within {:g} to {:g} x the estimate and below its p95, in >= {:g} % of the poses",
            min_of_estimate, max_of_estimate, 100.0 * min_covered),
        .found = fmt::format("{:.1f} % of {}", 100.0 * share, poses),
        .held = share >= min_covered};
}

} // namespace frustumscreen::bench
