/// Is what the exhibit says of its picture's error true? Each frame's estimate (app/scene/error_estimate.h) against the
/// ray cast.
///
/// Limit    A pose is covered if the true mean is 0.7 to 1.4 times the estimated one, and below the estimated 95th percentile.
/// Threads  the one whose context is current; the truth is cast on every core.
/// Errors   whatever the parts report, with the set-up's name in front.
#pragma once

#include "app/bench/measures/error_time.h"
#include "app/bench/measures/verdicts.h"

#include <span>
#include <string>
#include <vector>

namespace frustumscreen {

inline constexpr double least_of_estimate = 0.7;
inline constexpr double most_of_estimate = 1.4;
inline constexpr double least_covered = 0.9; ///< of the poses

struct Coverage {
    std::size_t poses = 0; ///< that show something of the artifact
    std::size_t covered = 0;
    std::size_t below_p95 = 0;
    Spread ratio; ///< the true mean over the estimated one
};
/// `errors` and `estimates` of the same poses.
[[nodiscard]] Coverage coverage_of(const TechniqueResult& technique);

struct EstimateOptions {
    int poses = 50;
    std::uint64_t seed = 1;
    /// A pixel, of which the true mean is taken: 1, 2, 4, 8 or 16. A handful of pixels, where an edge lies wrong, are half of a
    /// finest level's mean, and which places one ray a pixel meets is chance; more rays say how much of a miss that is.
    int rays = 1;
};
/// Every level and relief of the pack and what `auto` takes, without times.
[[nodiscard]] Result<SetUpResult> measure_estimates(const SetUp& set_up, const Pack& pack,
                                                    const std::shared_ptr<const SourceMesh>& mesh,
                                                    const EstimateOptions& options,
                                                    const StepProgress& progress);

/// Of one pack in one set-up.
struct NamedCoverage {
    std::string artifact;
    std::string set_up;
    std::string level;
    Coverage coverage;
};
/// One for each technique that has estimates.
[[nodiscard]] std::vector<NamedCoverage> coverages_of(const std::string& artifact, const SetUpResult& result);
[[nodiscard]] std::string coverage_table(std::span<const NamedCoverage> rows);
[[nodiscard]] std::string coverage_csv(std::span<const NamedCoverage> rows);
/// One row for each pose of each technique that has estimates.
inline constexpr const char* estimates_csv_header =
    "artifact,set_up,level,pose,true_mean_mm,true_p95_mm,estimated_mean_mm,estimated_p95_mm,truth_pixels\n";
[[nodiscard]] std::string estimates_csv(const std::string& artifact, const SetUpResult& result);
/// Of all poses together.
[[nodiscard]] LimitVerdict judge(std::span<const NamedCoverage> rows);

} // namespace frustumscreen
