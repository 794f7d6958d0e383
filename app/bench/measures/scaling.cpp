#include "app/bench/measures/scaling.h"

#include "assets_baked/artifacts/builtin.h"
#include "assets_baked/bake/bake.h"

#include <fmt/format.h>

#include <chrono>

namespace frustumscreen {

namespace {

/// Adds default level, finest level and two-pass of one size to the set and measures their errors.
Result<void> add_size(TechniqueSet& set, const ScalingSource& source, const std::vector<BenchPose>& poses,
                      const ScalingOptions& options, const Progress& progress) {
    const std::size_t first = set.results().size();
    const glm::dmat4 prop_from_artifact = place(source.pack, set.stage().prop).prop_from_artifact;
    Result<Truth> truth = Truth::build(source.mesh, prop_from_artifact);
    if (!truth) {
        return tl::unexpected<Error>(truth.error());
    }
    const auto finest = static_cast<std::uint32_t>(source.pack.levels.size() - 1);
    for (const std::uint32_t level : {source.pack.default_level, finest}) {
        if (Result<void> added = set.add_level(source.pack, level, options.picture); !added) {
            return added;
        }
    }
    if (Result<void> added =
            set.add_peers(*source.mesh, prop_from_artifact, false, {options.two_pass_pixels});
        !added) {
        return added;
    }
    return set.measure_errors(*truth, poses, first, progress);
}

Result<ScalingSource> bake_amphora(std::int64_t triangles, const ScalingOptions& options,
                                   const StepProgress& progress) {
    const std::string what = fmt::format("{} triangles: ", triangles);
    Result<SourceMesh> made = make_builtin("amphora", triangles);
    if (!made) {
        return tl::unexpected<Error>(made.error());
    }
    BakeOptions bake_options;
    bake_options.size = options.size;
    bake_options.unlit = true;
    bake_options.progress = [&](std::string_view step, double done) {
        progress(what + std::string(step), done);
    };
    const auto start = std::chrono::steady_clock::now();
    Result<Pack> pack = bake(*made, bake_options);
    const double bake_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!pack) {
        return at(what + "bake", pack.error());
    }
    return ScalingSource{std::make_shared<const SourceMesh>(std::move(*made)), std::move(*pack), bake_s};
}

} // namespace

Result<std::vector<ScalingSource>> bake_amphoras(const ScalingOptions& options,
                                                 const StepProgress& progress) {
    std::vector<ScalingSource> sources;
    for (const std::int64_t triangles : options.triangles) {
        Result<ScalingSource> source = bake_amphora(triangles, options, progress);
        if (!source) {
            return tl::unexpected<Error>(source.error());
        }
        sources.push_back(std::move(*source));
    }
    return sources;
}

Result<std::vector<ScalingRow>> scaling(const SetUp& set_up, const std::vector<ScalingSource>& sources,
                                        const ScalingOptions& options, const StepProgress& progress) {
    Result<std::unique_ptr<TechniqueSet>> opened = TechniqueSet::open(set_up);
    if (!opened) {
        return tl::unexpected<Error>(opened.error());
    }
    TechniqueSet& set = **opened;
    const Result<std::vector<BenchPose>> poses =
        draw_poses(set_up.settings, set.stage().prop, options.poses, options.seed);
    if (!poses) {
        return tl::unexpected<Error>(poses.error());
    }
    const std::size_t first = set.results().size(); // behind the floors
    std::vector<ScalingRow> rows;
    for (const ScalingSource& source : sources) {
        const std::string what = fmt::format("{} triangles: errors", source.mesh->triangles.size());
        const Result<void> added =
            add_size(set, source, *poses, options, [&](double done) { progress(what, done); });
        if (!added) {
            return at(what, added.error());
        }
        rows.push_back({source.mesh->triangles.size(), source.bake_s, {}, {}, {}});
    }
    set.measure_times(*poses, options.timing_rounds, [&](double done) { progress("times", done); });
    for (std::size_t k = 0; k < rows.size(); ++k) {
        rows[k].default_level = set.results()[first + 3 * k];
        rows[k].finest_level = set.results()[first + 1 + 3 * k];
        rows[k].two_pass = set.results()[first + 2 + 3 * k];
    }
    return rows;
}

std::string scaling_csv(std::span<const ScalingRow> rows) {
    std::string csv =
        "source_triangles,bake_s,technique,triangles,median_ms,p10_ms,p90_ms,times_floor,cpu_times_floor,"
        "mean_silhouette_percent,worst_silhouette_percent,mean_geometric_mm,worst_geometric_mm,"
        "mean_rmse_16_rays,worst_rmse_16_rays\n";
    for (const ScalingRow& row : rows) {
        for (const TechniqueResult* technique : {&row.default_level, &row.finest_level, &row.two_pass}) {
            const PictureError& mean = technique->error.mean;
            const PictureError& worst = technique->error.worst;
            csv += fmt::format("{},{:.2f},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.5f},{:.5f},{:.6f},{:."
                               "6f},{:.4f},{:.4f}\n",
                               row.source_triangles, row.bake_s, technique->name, technique->triangles,
                               technique->time_ms.median, technique->time_ms.p10, technique->time_ms.p90,
                               technique->times_floor, technique->cpu_times_floor, mean.silhouette_percent,
                               worst.silhouette_percent, mean.geometric_mean_mm, worst.geometric_mean_mm,
                               mean.sixteen_rays.rmse, worst.sixteen_rays.rmse);
        }
    }
    return csv;
}

std::string scaling_table(std::span<const ScalingRow> rows) {
    std::string table = fmt::format("{:>16}{:>9}{:>20}{:>20}{:>20}\n", "source triangles", "bake s",
                                    "default x floor", "finest x floor", "two-pass x floor");
    for (const ScalingRow& row : rows) {
        table += fmt::format("{:>16}{:>9.1f}{:>20.2f}{:>20.2f}{:>20.2f}\n", row.source_triangles, row.bake_s,
                             row.default_level.times_floor, row.finest_level.times_floor,
                             row.two_pass.times_floor);
    }
    if (rows.size() > 1) {
        const double growth = rows.back().default_level.times_floor / rows.front().default_level.times_floor;
        table += fmt::format("{} default level at {} triangles <= {:g} x that at {} ({:.2f} x)\n",
                             growth <= most_growth ? "held  " : "MISSED", rows.back().source_triangles,
                             most_growth, rows.front().source_triangles, growth);
    }
    return table;
}

} // namespace frustumscreen
