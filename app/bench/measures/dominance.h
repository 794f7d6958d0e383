/// Checks whether another technique is cheaper and no worse. Judged twice: by shape (mean silhouette and
/// geometric error) among pictures with equal samples per pixel; and by colour (16 rays) among all.
///
/// Tolerance  times are noisy: a peer dominates only if it is cheaper by more than `cost_tolerance`; a peer
///            with no larger errors at about equal cost is only named.
/// Threads    pure; any.
#pragma once

#include "app/bench/measures/verdicts.h"

#include <string>
#include <vector>

namespace frustumscreen::bench {

inline constexpr double cost_tolerance = 0.05;

/// False for the pack's own levels and reliefs, the choice of `auto`, our own relief at other resolutions and
/// the floor.
[[nodiscard]] bool is_judged_peer(TechniqueKind kind);
/// The pack's levels and reliefs.
[[nodiscard]] bool is_judged_level(TechniqueKind kind);
/// No larger error in silhouette, geometry and colour.
[[nodiscard]] bool errs_no_more(const TechniqueResult& a, const TechniqueResult& b);

enum class Dominance { Shape, Colour };
/// Names of the techniques that dominate a level, separated by "; "; empty if none does.
[[nodiscard]] std::string dominated_by(const SetUpResult& result, const TechniqueResult& level, Dominance by);

/// Every technique, except that one mesh's two-pass pictures are reduced to the one with the best eye image:
/// the cheapest that no other betters at about equal cost.
[[nodiscard]] std::vector<const TechniqueResult*> at_best_eye_images(const SetUpResult& result);

/// Two verdicts per level and relief of the pack. None without peers; none by shape if no peer has equal
/// samples; none by colour for a pack with baked light. Every eye image counts here.
[[nodiscard]] std::vector<LimitVerdict> judge_dominance(const SetUpResult& result);

} // namespace frustumscreen::bench
