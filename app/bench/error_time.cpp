#include "app/bench/error_time.h"

#include <algorithm>

namespace frustumscreen {

namespace {

/// Fewer frame times than this have no steady median on a busy machine.
constexpr int least_samples = 60;

Result<SetUpResult> compare(const SetUp& set_up, const Pack& pack,
                            const std::shared_ptr<const SourceMesh>& mesh, const ErrorTimeOptions& options,
                            const StepProgress& progress) {
    Result<std::unique_ptr<TechniqueSet>> opened = TechniqueSet::open(set_up);
    if (!opened) {
        return tl::unexpected<Error>(opened.error());
    }
    TechniqueSet& set = **opened;
    Result<std::vector<BenchPose>> poses =
        draw_poses(set_up.settings, set.stage().prop, options.poses, options.seed);
    if (!poses) {
        return tl::unexpected<Error>(poses.error());
    }
    const glm::dmat4 prop_from_artifact = place(pack, set.stage().prop).prop_from_artifact;
    Result<Truth> truth = Truth::build(mesh, prop_from_artifact);
    if (!truth) {
        return tl::unexpected<Error>(truth.error());
    }
    Result<void> ready;
    for (std::uint32_t level = 0; ready && level < pack.levels.size(); ++level) {
        ready = set.add_level(pack, level, options.picture);
    }
    if (ready && options.peers) {
        ready = set.add_peers(*mesh, prop_from_artifact, true, options.two_pass_pixels);
    }
    if (ready) {
        ready = set.measure_errors(*truth, *poses, 0,
                                   [&](double done) { progress(set_up.name + ": errors", done); });
    }
    if (!ready) {
        return tl::unexpected<Error>(ready.error());
    }
    const int rounds = std::max(options.timing_rounds, least_samples / options.poses);
    set.measure_times(*poses, rounds, [&](double done) { progress(set_up.name + ": times", done); });
    return SetUpResult{set_up.name,        set.driver(),
                       pack.default_level, static_cast<std::uint32_t>(pack.levels.size() - 1),
                       std::move(*poses),  set.results()};
}

} // namespace

Result<SetUpResult> error_time(const SetUp& set_up, const Pack& pack,
                               const std::shared_ptr<const SourceMesh>& mesh, const ErrorTimeOptions& options,
                               const StepProgress& progress) {
    Result<SetUpResult> result = compare(set_up, pack, mesh, options, progress);
    return result ? std::move(result) : at(set_up.name, result.error());
}

} // namespace frustumscreen
