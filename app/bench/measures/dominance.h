/// Is anything else cheaper and no worse? Pareto dominance over four figures: cost, and mean silhouette,
/// geometric and colour error (16 rays).
///
/// Tolerance  times are noisy: a peer dominates only if it is cheaper by more than `cost_tolerance`; a peer
///            with no larger errors at about the same cost is only named.
/// Threads    pure; any.
#pragma once

#include "app/bench/measures/verdicts.h"

#include <vector>

namespace frustumscreen {

inline constexpr double cost_tolerance = 0.05;

/// False for the pack's own levels, our own relief, the floor, and the ray cast, which is a reference.
[[nodiscard]] bool is_judged_peer(TechniqueKind kind);
[[nodiscard]] bool errs_no_more(const TechniqueResult& a, const TechniqueResult& b);

/// Every technique, but of one mesh's two-pass pictures only the one with the best eye image: the cheapest
/// that no other betters at about the same cost.
[[nodiscard]] std::vector<const TechniqueResult*> at_best_eye_images(const SetUpResult& result);

/// One verdict for each level of the pack; none without peers. Every eye image counts here.
[[nodiscard]] std::vector<Verdict> judge_dominance(const SetUpResult& result);

} // namespace frustumscreen
