/// Error against run time: every technique over the same poses, measured against the truth and timed in one
/// interleaved run; once per set-up.
///
/// Threads  the one whose context is current; the truth is cast on every core.
/// Errors   any error from the parts, with the set-up's name in front.
#pragma once

#include "app/bench/measures/technique_set.h"
#include "app/bench/measures/time_left.h"

namespace frustumscreen::bench {

struct SetUpResult {
    std::string name;
    std::string driver;
    std::uint32_t default_level = 0;
    std::uint32_t finest_level = 0;
    /// The levels' colours contain baked light and the peers' do not, so they are compared by shape alone.
    bool baked_light = false;
    std::vector<BenchPose> poses;
    std::vector<TechniqueResult> techniques; ///< the floor first
    /// `error_picture` of the default and the finest level, each in the pose with its greatest geometric
    /// error.
    std::vector<std::pair<std::string, image::Image8>> worst;
};

struct ErrorTimeOptions {
    int poses = 50;
    std::uint64_t seed = 1;
    int timing_rounds = 3; ///< minimum; a small number of poses is drawn more often
    PictureOptions picture;
    PeerChoice peers;
};

/// Reports the current step and the completed share of it.
using StepProgress = std::function<void(const std::string& step, double done)>;

/// The steps that `error_time` reports, with estimates of their seconds.
[[nodiscard]] std::vector<WorkStep> work_steps(const SetUp& set_up, const pack::Pack& pack,
                                               const bake::SourceMesh& mesh, const ErrorTimeOptions& options);

[[nodiscard]] Result<SetUpResult> error_time(const SetUp& set_up, const pack::Pack& pack,
                                             const std::shared_ptr<const bake::SourceMesh>& mesh,
                                             const ErrorTimeOptions& options, const StepProgress& progress);

} // namespace frustumscreen::bench
