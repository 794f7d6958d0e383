/// Is anything else cheaper and no worse? Judged twice: by shape, mean silhouette and geometric error, among pictures of as many
/// samples a pixel; and, apart from that, by colour (16 rays), among all.
///
/// Tolerance  times are noisy: a peer dominates only if it is cheaper by more than `cost_tolerance`; a peer
///            with no larger errors at about the same cost is only named.
/// Threads    pure; any.
#pragma once

#include "app/bench/measures/verdicts.h"

#include <string>
#include <vector>

namespace frustumscreen {

inline constexpr double cost_tolerance = 0.05;

/// False for the pack's own levels and reliefs, what `auto` takes, our own relief of other resolutions and the floor.
[[nodiscard]] bool is_judged_peer(TechniqueKind kind);
/// The pack's levels and reliefs.
[[nodiscard]] bool is_judged_level(TechniqueKind kind);
/// In silhouette, geometry and colour.
[[nodiscard]] bool errs_no_more(const TechniqueResult& a, const TechniqueResult& b);

enum class Dominance { Shape, Colour };
/// The names of those that dominate a level, with "; " between; empty = none does.
[[nodiscard]] std::string dominated_by(const SetUpResult& result, const TechniqueResult& level, Dominance by);

/// Every technique, but of one mesh's two-pass pictures only the one with the best eye image: the cheapest
/// that no other betters at about the same cost.
[[nodiscard]] std::vector<const TechniqueResult*> at_best_eye_images(const SetUpResult& result);

/// Two verdicts for each level and relief of the pack; none without peers, none by shape where no peer has as many samples, none by colour
/// of a pack with baked light. Every eye image counts here.
[[nodiscard]] std::vector<LimitVerdict> judge_dominance(const SetUpResult& result);

} // namespace frustumscreen
