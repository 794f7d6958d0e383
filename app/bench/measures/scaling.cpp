#include "app/bench/measures/scaling.h"

#include "app/bench/measures/subdivide.h"
#include "assets_baked/artifacts/builtin.h"
#include "assets_baked/bake/bake.h"

#include <fmt/format.h>

#include <array>
#include <chrono>

namespace frustumscreen::bench {

namespace {

/// The techniques drawn for each size, in this order.
constexpr std::array drawn = {&ScalingRow::default_level, &ScalingRow::finest_level, &ScalingRow::relief,
                              &ScalingRow::two_pass};

/// Adds the techniques of one size to the set and measures their errors.
Result<void> add_size(TechniqueSet& set, const ScalingSource& source, const std::vector<BenchPose>& poses,
                      const ScalingOptions& options, const Progress& progress) {
    const std::size_t first = set.results().size();
    const glm::dmat4 prop_from_artifact = pack::place(source.pack, set.kiosk().prop).prop_from_artifact;
    TRY(Truth truth, Truth::build(source.mesh, prop_from_artifact));
    const auto finest = static_cast<std::uint32_t>(source.pack.levels.size() - 1);
    for (const std::uint32_t level : {source.pack.default_level, finest}) {
        TRY_VOID(set.add_level(source.pack, level, options.picture));
    }
    TRY_VOID(set.add_finest_relief(source.pack, options.picture));
    TRY_VOID(set.add_peers(*source.mesh, prop_from_artifact, false, {options.two_pass_pixels}));
    return set.measure_errors(truth, poses, first, progress);
}

Result<bake::SourceMesh> make_amphora(std::int64_t triangles, const ScalingOptions& options) {
    Result<bake::SourceMesh> made =
        artifacts::make_builtin("amphora", options.same_surface ? options.triangles.front() : triangles);
    while (made && options.same_surface && std::ssize(made->triangles) < triangles * 9 / 10) {
        *made = subdivide(*made);
    }
    return made;
}

Result<ScalingSource> bake_amphora(std::int64_t triangles, const ScalingOptions& options,
                                   const StepProgress& progress) {
    const std::string what = fmt::format("{} triangles: ", triangles);
    TRY(bake::SourceMesh made, make_amphora(triangles, options));
    bake::BakeOptions bake_options;
    bake_options.size = options.size;
    bake_options.unlit = true;
    bake_options.progress = [&](std::string_view step, double done) {
        progress(what + std::string(step), done);
    };
    const auto start = std::chrono::steady_clock::now();
    Result<pack::Pack> baked = bake::bake(made, bake_options);
    const double bake_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    TRY(pack::Pack pack, at(what + "bake", std::move(baked)));
    return ScalingSource{std::make_shared<const bake::SourceMesh>(std::move(made)), std::move(pack), bake_s};
}

std::string growth_line(std::string_view name, TechniqueResult ScalingRow::*each, double most,
                        std::span<const ScalingRow> rows) {
    const TechniqueResult& small = rows.front().*each;
    const TechniqueResult& large = rows.back().*each;
    const double growth = large.times_floor / small.times_floor;
    return fmt::format("{} {} at {} triangles <= {:g} x that at {} ({:.2f} x; by processor time {:.2f} x)\n",
                       growth <= most ? "held  " : "MISSED", name, rows.back().source_triangles, most,
                       rows.front().source_triangles, growth, large.cpu_times_floor / small.cpu_times_floor);
}

} // namespace

Result<std::vector<ScalingSource>> bake_amphoras(const ScalingOptions& options,
                                                 const StepProgress& progress) {
    std::vector<ScalingSource> sources;
    for (const std::int64_t triangles : options.triangles) {
        TRY(ScalingSource source, bake_amphora(triangles, options, progress));
        sources.push_back(std::move(source));
    }
    return sources;
}

Result<std::vector<ScalingRow>> scaling(const SetUp& set_up, const std::vector<ScalingSource>& sources,
                                        const ScalingOptions& options, const StepProgress& progress) {
    TRY(std::unique_ptr<TechniqueSet> opened, TechniqueSet::open(set_up));
    TechniqueSet& set = *opened;
    TRY(const std::vector<BenchPose> poses,
        draw_poses(set_up.settings, set.kiosk().prop, options.poses, options.seed));
    const std::size_t first = set.results().size(); // after the floors
    std::vector<ScalingRow> rows;
    for (const ScalingSource& source : sources) {
        const std::string what = fmt::format("{} triangles: errors", source.mesh->triangles.size());
        TRY_VOID(at(what, add_size(set, source, poses, options, [&](double done) { progress(what, done); })));
        rows.push_back({.source_triangles = source.mesh->triangles.size(),
                        .bake_s = source.bake_s,
                        .default_level = {},
                        .finest_level = {},
                        .relief = {},
                        .two_pass = {}});
    }
    set.measure_times(poses, options.timing_rounds, [&](double done) { progress("times", done); });
    for (std::size_t k = 0; k < rows.size(); ++k) {
        for (std::size_t i = 0; i < drawn.size(); ++i) {
            rows[k].*drawn[i] = set.results()[first + drawn.size() * k + i];
        }
    }
    return rows;
}

std::string scaling_csv(std::span<const ScalingRow> rows) {
    std::string csv =
        "source_triangles,bake_s,technique,triangles,median_ms,p10_ms,p90_ms,times_floor,cpu_times_floor,"
        "mean_silhouette_percent,worst_silhouette_percent,mean_geometric_mm,worst_geometric_mm,"
        "mean_rmse_16_rays,worst_rmse_16_rays\n";
    for (const ScalingRow& row : rows) {
        for (TechniqueResult ScalingRow::*const each : drawn) {
            const TechniqueResult& technique = row.*each;
            const PictureError& mean = technique.error.mean;
            const PictureError& worst = technique.error.worst;
            csv += fmt::format("{},{:.2f},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.5f},{:.5f},{:.6f},{:."
                               "6f},{:.4f},{:.4f}\n",
                               row.source_triangles, row.bake_s, technique.name, technique.triangles,
                               technique.time_ms.median, technique.time_ms.p10, technique.time_ms.p90,
                               technique.times_floor, technique.cpu_times_floor, mean.silhouette_percent,
                               worst.silhouette_percent, mean.geometric_mean_mm, worst.geometric_mean_mm,
                               mean.sixteen_rays.rmse, worst.sixteen_rays.rmse);
        }
    }
    return csv;
}

std::string scaling_table(std::span<const ScalingRow> rows) {
    std::string table = fmt::format("{:>16}{:>9}", "source triangles", "bake s");
    for (const char* name : {"default", "finest", "relief", "two-pass"}) {
        table += fmt::format("{:>20}", fmt::format("{} x floor", name));
    }
    table += '\n';
    for (const ScalingRow& row : rows) {
        table += fmt::format("{:>16}{:>9.1f}", row.source_triangles, row.bake_s);
        for (TechniqueResult ScalingRow::*const each : drawn) {
            table += fmt::format("{:>20.2f}", (row.*each).times_floor);
        }
        table += '\n';
    }
    return rows.size() > 1
               ? table + growth_line("default level", &ScalingRow::default_level, max_growth, rows) +
                     growth_line("finest relief", &ScalingRow::relief, max_relief_growth, rows)
               : table;
}

} // namespace frustumscreen::bench
