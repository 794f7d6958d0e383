#include "app/bench/measures/error_time.h"

#include "app/bench/measures/comparison.h"
#include "app/bench/measures/side_by_side.h"
#include "app/pack/pack_relief.h"

#include <algorithm>
#include <numeric>

namespace frustumscreen::bench {

namespace {

/// Fewer frame times give no steady median on a busy machine.
constexpr int min_samples = 60;

int rounds_of(const ErrorTimeOptions& options) {
    return std::max(options.timing_rounds, min_samples / options.poses);
}

/// A picture of the pack's level in the pose with the greatest geometric error.
Result<image::Image8> worst_picture(TechniqueSet& set, const Truth& truth,
                                    const std::vector<BenchPose>& poses, std::uint32_t level) {
    std::size_t k = 0;
    while (set.results()[k].kind != TechniqueKind::PackLevel ||
           set.results()[k].level != static_cast<int>(level)) {
        ++k;
    }
    const std::vector<PictureError>& errors = set.results()[k].errors;
    const auto worst = std::max_element(errors.begin(), errors.end(), [](const auto& a, const auto& b) {
        return a.geometric_mean_mm < b.geometric_mean_mm;
    });
    const BenchPose& pose = poses[static_cast<std::size_t>(worst - errors.begin())];
    TRY(const Drawn drawn, set.drawn(k, pose));
    return error_picture(truth.cast(set.kiosk().prop, view_of(set.kiosk().settings, pose), true), drawn);
}

Result<void> add_peers(TechniqueSet& set, const bake::SourceMesh& mesh, const Truth& truth,
                       const pack::Pack& pack, const glm::dmat4& prop_from_artifact, PeerChoice choice,
                       const PictureOptions& picture) {
    if (choice.samples.empty()) {
        choice.samples = pack.samples > 1 ? std::vector{1, pack.samples} : std::vector{1};
    }
    Result<void> added;
    if (choice.mesh || choice.two_pass) {
        added = set.add_peers(mesh, prop_from_artifact, choice.mesh,
                              choice.two_pass ? choice.eye_pixels : std::vector<int>{}, choice.samples);
    }
    if (added && choice.ray_cast) {
        added = set.add_ray_cast(truth, choice.samples);
    }
    if (added && (choice.lod || choice.two_pass_lod)) {
        added = set.add_levels_of_detail(mesh, prop_from_artifact, choice);
    }
    if (added && choice.relief) {
        added = set.add_relief_peers(truth, mesh, prop_from_artifact, choice.relief_texels);
    }
    if (added && choice.relief_cast) {
        added = set.add_relief_rasters(pack, choice.cast_texels, picture);
    }
    if (added && choice.relief_gpu) {
        added = set.add_reliefs_on_gpu(pack, picture);
    }
    return added;
}

Result<SetUpResult> compare(const SetUp& set_up, const pack::Pack& pack,
                            const std::shared_ptr<const bake::SourceMesh>& mesh,
                            const ErrorTimeOptions& options, const StepProgress& progress) {
    progress(set_up.name + ": meshes", 0.0);
    std::vector<std::uint32_t> levels(pack.levels.size());
    std::iota(levels.begin(), levels.end(), 0U);
    TRY(Comparison opened,
        open_comparison(set_up, pack, levels, mesh, {options.picture, options.poses, options.seed}));
    auto& [set, poses, truth, prop_from_artifact] = opened;
    Result<void> ready = set->add_auto(pack, options.picture)
                             .and_then([&] { return set->add_reliefs(pack, options.picture); })
                             .and_then([&] {
                                 return add_peers(*set, *mesh, truth, pack, prop_from_artifact, options.peers,
                                                  options.picture);
                             });
    progress(set_up.name + ": meshes", 1.0);
    progress(set_up.name + ": errors", 0.0);
    if (ready) {
        ready = set->measure_errors(truth, poses, 0,
                                    [&](double done) { progress(set_up.name + ": errors", done); });
    }
    TRY_VOID(ready);
    progress(set_up.name + ": times", 0.0);
    set->measure_times(poses, rounds_of(options),
                       [&](double done) { progress(set_up.name + ": times", done); });
    const auto finest = static_cast<std::uint32_t>(pack.levels.size() - 1);
    SetUpResult result{.name = set_up.name,
                       .driver = set->driver(),
                       .default_level = pack.default_level,
                       .finest_level = finest,
                       .baked_light = !pack.unlit,
                       .poses = {},
                       .techniques = set->results(),
                       .worst = {}};
    for (const auto& [name, level] :
         {std::pair("default", pack.default_level), std::pair("finest", finest)}) {
        TRY(image::Image8 picture, worst_picture(*set, truth, poses, level));
        result.worst.emplace_back(name, std::move(picture));
    }
    result.poses = std::move(poses);
    return result;
}

} // namespace

std::vector<WorkStep> work_steps(const SetUp& set_up, const pack::Pack& pack, const bake::SourceMesh& mesh,
                                 const ErrorTimeOptions& options) {
    const PeerChoice& peers = options.peers;
    const auto eye_images = static_cast<double>(peers.eye_pixels.size());
    const auto details = static_cast<double>(peers.lod_triangles.size());
    const auto times = static_cast<double>(std::max<std::size_t>(peers.samples.size(), 2));
    const double full = times * ((peers.mesh ? 1.0 : 0.0) + (peers.two_pass ? eye_images : 0.0));
    const auto reliefs =
        static_cast<double>(pack::reliefs_of(pack).value_or(std::vector<pack::ReliefOutline>{}).size());
    constexpr double as_many_frames = 10.0; // assumes a driver that draws on the processor
    const double small = static_cast<double>(pack.levels.size()) +
                         (peers.relief_gpu ? 1.0 + as_many_frames : 1.0) * reliefs + 2.0 +
                         times * ((peers.ray_cast ? 1.0 : 0.0) + (peers.lod ? details : 0.0) +
                                  (peers.two_pass_lod ? details * eye_images : 0.0));
    const auto triangles = static_cast<double>(mesh.triangles.size());
    const double frames_s = 0.012 * (small + full) + 1.5e-7 * triangles * full; // one frame of each
    return {
        {set_up.name + ": meshes", "meshes", 0.5 + 4e-6 * triangles},
        {set_up.name + ": errors", "errors", options.poses * (0.3 + 0.04 * (small + full) + 4.0 * frames_s)},
        {set_up.name + ": times", "times", options.poses * rounds_of(options) * frames_s}};
}

Result<SetUpResult> error_time(const SetUp& set_up, const pack::Pack& pack,
                               const std::shared_ptr<const bake::SourceMesh>& mesh,
                               const ErrorTimeOptions& options, const StepProgress& progress) {
    return at(set_up.name, compare(set_up, pack, mesh, options, progress));
}

} // namespace frustumscreen::bench
