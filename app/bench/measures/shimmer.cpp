#include "app/bench/measures/shimmer.h"

#include "app/bench/measures/comparison.h"

namespace frustumscreen::bench {

namespace {

/// Measures the default and finest level over every pose and direction.
void measure(TechniqueSet& set, const Truth& truth, const ShimmerOptions& options, const Progress& progress,
             ShimmerResult& result) {
    double worst_percent = -1.0;
    const int sequences = 2 * static_cast<int>(result.poses.size());
    for (int k = 0; k < sequences; ++k) {
        const PushDirection direction = k % 2 == 0 ? PushDirection::Row : PushDirection::Column;
        ShimmerSequence sequence(set.kiosk().settings, set.kiosk().prop,
                                 result.poses[static_cast<std::size_t>(k / 2)], direction, options.steps);
        sequence.cast(truth, options.sixteen_rays);
        for (std::size_t technique = 0; technique < set.results().size(); ++technique) {
            if (set.results()[technique].kind != TechniqueKind::PackLevel) {
                continue;
            }
            ShimmerMaps maps;
            const SequenceShimmer found =
                sequence.judge([&](const BenchPose& pose) { return set.picture(technique, pose); }, maps);
            if (found.excess_percent() > worst_percent) {
                worst_percent = found.excess_percent();
                result.worst = side_by_side(maps);
            }
            result.rows.push_back({.technique = set.results()[technique].name,
                                   .pose = k / 2,
                                   .direction = direction,
                                   .shimmer = found});
        }
        progress(static_cast<double>(k + 1) / sequences);
    }
}

Result<ShimmerResult> compare(const SetUp& set_up, const pack::Pack& pack,
                              const std::shared_ptr<const bake::SourceMesh>& mesh,
                              const ShimmerOptions& options, const StepProgress& progress) {
    TRY(Comparison opened, open_comparison(set_up, pack, default_and_finest(pack), mesh,
                                           {options.picture, options.poses, options.seed}));
    ShimmerResult result{
        .name = set_up.name, .poses = std::move(opened.poses), .rows = {}, .worst = {}, .edges = {}};
    measure(
        *opened.set, opened.truth, options, [&](double done) { progress(set_up.name + ": shimmer", done); },
        result);
    return result;
}

} // namespace

Result<ShimmerResult> shimmer(const SetUp& set_up, const pack::Pack& pack,
                              const std::shared_ptr<const bake::SourceMesh>& mesh,
                              const ShimmerOptions& options, const StepProgress& progress) {
    TRY(ShimmerResult result, at(set_up.name, compare(set_up, pack, mesh, options, progress)));
    TRY(result.edges,
        at(set_up.name, edge_sparkle(set_up, pack, result.poses, options.steps, options.picture,
                                     [&](double done) { progress(set_up.name + ": edges", done); })));
    return result;
}

} // namespace frustumscreen::bench
