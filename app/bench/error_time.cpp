#include "app/bench/error_time.h"

#include "app/bench/side_by_side.h"

#include <algorithm>

namespace frustumscreen {

namespace {

/// Fewer frame times than this have no steady median on a busy machine.
constexpr int least_samples = 60;

/// The pack's level `level` where its geometric error is greatest.
Result<Image8> worst_picture(TechniqueSet& set, const Truth& truth, const std::vector<BenchPose>& poses,
                             std::uint32_t level) {
    std::size_t k = 0;
    while (set.results()[k].level != static_cast<int>(level)) {
        ++k;
    }
    const std::vector<PictureError>& errors = set.results()[k].errors;
    const auto worst = std::max_element(errors.begin(), errors.end(), [](const auto& a, const auto& b) {
        return a.geometric_mean_mm < b.geometric_mean_mm;
    });
    const BenchPose& pose = poses[static_cast<std::size_t>(worst - errors.begin())];
    const Result<Drawn> drawn = set.drawn(k, pose);
    if (!drawn) {
        return tl::unexpected<Error>(drawn.error());
    }
    return error_picture(truth.cast(set.stage().prop, view_of(set.stage().settings, pose), true), *drawn);
}

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
    if (ready && options.relief_peers) {
        ready = set.add_relief_peers(*truth, *mesh, prop_from_artifact, options.relief_texels);
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
    const auto finest = static_cast<std::uint32_t>(pack.levels.size() - 1);
    SetUpResult result{set_up.name, set.driver(), pack.default_level, finest, {}, set.results(), {}};
    for (const auto& [name, level] :
         {std::pair("default", pack.default_level), std::pair("finest", finest)}) {
        Result<Image8> picture = worst_picture(set, *truth, *poses, level);
        if (!picture) {
            return tl::unexpected<Error>(picture.error());
        }
        result.worst.emplace_back(name, std::move(*picture));
    }
    result.poses = std::move(*poses);
    return result;
}

} // namespace

Result<SetUpResult> error_time(const SetUp& set_up, const Pack& pack,
                               const std::shared_ptr<const SourceMesh>& mesh, const ErrorTimeOptions& options,
                               const StepProgress& progress) {
    Result<SetUpResult> result = compare(set_up, pack, mesh, options, progress);
    return result ? std::move(result) : at(set_up.name, result.error());
}

} // namespace frustumscreen
