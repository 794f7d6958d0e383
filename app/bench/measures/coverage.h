/// Checks the exhibit's estimate of its picture error (app/scene/error_estimate.h), frame by frame, against
/// the ray cast.
///
/// Limit    A pose is covered if the true mean is 0.7 to 1.4 times the estimated mean, and below the
///          estimated 95th percentile.
/// Threads  the one whose context is current; the truth is cast on every core.
/// Errors   any error from the parts, with the set-up's name in front.
#pragma once

#include "app/bench/measures/error_time.h"
#include "app/bench/measures/verdicts.h"

#include <span>
#include <string>
#include <vector>

namespace frustumscreen::bench {

inline constexpr double min_of_estimate = 0.7;
inline constexpr double max_of_estimate = 1.4;
inline constexpr double min_covered = 0.9; ///< share of the poses

struct Coverage {
    std::size_t poses = 0; ///< poses that show part of the artifact
    std::size_t covered = 0;
    std::size_t below_p95 = 0;
    Spread ratio; ///< true mean over estimated mean
};
/// Compares `errors` and `estimates` of the same poses.
[[nodiscard]] Coverage coverage_of(const TechniqueResult& technique);

struct EstimateOptions {
    int poses = 50;
    std::uint64_t seed = 1;
    /// Rays per pixel for the true mean: 1, 2, 4, 8 or 16. A handful of pixels with a wrong edge make up half
    /// of a finest level's mean, and with one ray per pixel chance decides which places it meets; more rays
    /// show how large such an error is.
    int rays = 1;
};
/// Every level and relief of the pack and the level that `auto` chooses, without times.
[[nodiscard]] Result<SetUpResult> measure_estimates(const SetUp& set_up, const pack::Pack& pack,
                                                    const std::shared_ptr<const bake::SourceMesh>& mesh,
                                                    const EstimateOptions& options,
                                                    const StepProgress& progress);

/// One pack in one set-up.
struct NamedCoverage {
    std::string artifact;
    std::string set_up;
    std::string level;
    Coverage coverage;
};
/// One entry per technique with estimates.
[[nodiscard]] std::vector<NamedCoverage> coverages_of(const std::string& artifact, const SetUpResult& result);
[[nodiscard]] std::string coverage_table(std::span<const NamedCoverage> rows);
[[nodiscard]] std::string coverage_csv(std::span<const NamedCoverage> rows);
/// One row per pose of each technique with estimates.
inline constexpr const char* estimates_csv_header =
    "artifact,set_up,level,pose,true_mean_mm,true_p95_mm,estimated_mean_mm,estimated_p95_mm,truth_pixels\n";
[[nodiscard]] std::string estimates_csv(const std::string& artifact, const SetUpResult& result);
/// All poses together.
[[nodiscard]] LimitVerdict judge(std::span<const NamedCoverage> rows);

} // namespace frustumscreen::bench
