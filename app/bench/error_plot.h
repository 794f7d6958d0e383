/// Error over cost as SVG: of one artifact, and of many on one sheet.
///
/// Each family of techniques has its colour and mark in all of them; a line joins those of its members that
/// are on the family's Pareto front. Of the two-pass pictures of one mesh that of the best eye image is shown
/// (dominance.h).
///
/// Threads  pure; any.
#pragma once

#include "app/bench/measures/error_time.h"

#include <span>
#include <string>

namespace frustumscreen {

/// Three plots: silhouette, geometric and colour error over cost.
[[nodiscard]] std::string error_time_svg(const SetUpResult& result, const std::string& pack_title);

/// What one run of error-time found.
struct ArtifactResults {
    std::string title;
    std::vector<SetUpResult> set_ups;
};
/// A row of the three plots for each set-up: every artifact's members as faint marks, and for each family the
/// error that at least half of the artifacts reach at a cost (attainment.h).
[[nodiscard]] std::string overall_svg(std::span<const ArtifactResults> artifacts);

} // namespace frustumscreen
