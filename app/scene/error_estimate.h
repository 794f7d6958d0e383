/// How far what a frame shows lies from the scan: the distance, along the eye's ray through each pixel, between
/// what the level shows there and what the scan would show; its mean and 95th percentile over the frame's pixels.
///
/// Derivation
///   Level     The bake casts rays from eyes all around at each level and at the source (SeenErrors). Which eye it is
///             decides: the ray through a surface that is off by d along its normal is off by d / cos, and where an
///             edge hides something else, by as much as lies between. Both change slowly with the eye, but for noise, so
///             the eye's own figure is the mean of its neighbours', weighted by exp(-(angle / spread)^2 / 2). Scaled to the
///             prop: an error is a length, and the placement's scale is all that a larger prop changes.
///   Edges     Where an edge lies wrong, a ray meets what is behind it: a few of ten thousand rays, and each counts a thousand
///             times as much as another. What one eye's rays happen to meet of that says little about what a picture's pixels will.
///             So the bake finds how far a level's edges move from all eyes together, and what an eye sees of it from how much
///             lies behind the edges that it sees (assets_baked/bake/seen_error.cpp).
///   Faces     The bake's rays are even; pixels are not. The projector gives a face that is turned to it up to three times
///             as many of them, for what the eye sees through it, as a steep one, and an artifact's parts are not equally
///             wrong. So each patch of what an eye saw counts by its share of rays times the pixels a square metre
///             (FacePlan::pixels_per_m squared) of the face that the eye sees the patch through.
///   Pixels    What a pixel shows lies beside its place by a share of it: by what 32-bit numbers leave of a picture 1920 pixels
///             wide, .00015 px on llvmpipe, which moves a triangle's edges to its grid of 1/256 pixel and not what its corners
///             carry. As a length on the artifact that is a pixel's size there, times the surface's steepness for this eye
///             (SeenEye::steepness). It matters to the finest levels alone. A GPU that moves what the corners carry as well
///             shows .0011 px: 1 / (256 sqrt 6) in two directions, of which a place between three corners keeps sqrt(1/2).
///             That is some micrometres, and is left out.
///   Together  the two know nothing of each other: their squares add.
///   Older     packs without SeenErrors know the mean distance D between the surfaces alone. Over the rays that meet a
///             surface, the mean of d / cos is the sum of d over its visible area, divided by its silhouette: D times visible
///             area over silhouette. That is 2 for a convex body, in the mean of all eyes (Cauchy: a silhouette is a quarter of
///             the surface, and half of it is seen). What edges hide is left out, so these estimates are too small.
///   Chance    A finest level moves edges by a thousandth of a pixel. Then it depends on where pixels' centres lie whether any, or
///             three, show what is behind them, and that is half of the mean: no estimate knows it.
/// Held against  models that it was not made with: `frustumscreen-bench estimate`, docs/bench.md.
///
/// Units    millimetres on the configured prop.
/// Threads  pure; any. `estimate_error` allocates nothing.
/// Errors   none: a frame that shows nothing of the artifact has no estimate.
#pragma once

#include "app/pack/pack_outline.h"
#include "app/pack/seen_errors.h"
#include "app/scene/frame_plan.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace frustumscreen {

struct ErrorEstimate {
    double mean_mm = 0.0;
    double p95_mm = 0.0;
};

/// One level as eyes all around see it.
struct SeenLevel {
    std::vector<SeenEye> eyes; ///< as SeenErrors; one at least
    std::vector<SeenError> errors;
};
/// What is known of a level where no eye was asked.
[[nodiscard]] SeenLevel derived(const LevelError& error, const glm::dvec3& box_size);
/// All of a pack: one for each level, and one for each relief that is cast, in the order of `reliefs_of`.
struct SeenByEyes {
    std::vector<SeenLevel> levels, reliefs;
};
/// Derived where the pack has no SeenErrors. Errors: as seen_errors_of.
[[nodiscard]] Result<SeenByEyes> seen_by_eyes(const PackOutline& pack);

/// Each figure as the eye sees it that sees the most of it.
[[nodiscard]] SeenError worst_of(const SeenLevel& seen);

/// `plan`: of `level` alone, for `view`, of which the first eye counts.
[[nodiscard]] std::optional<ErrorEstimate> estimate_error(const SeenLevel& seen, const PropShape& prop,
                                                          const PlacedLevel& level, const PlanView& view,
                                                          const FramePlan& plan);

} // namespace frustumscreen
