/// Estimated error of a frame against the scan: the distance, along the eye's ray through each pixel, between
/// what the level shows and what the scan would show. Mean and 95th percentile over the frame's pixels.
///
/// Derivation
///   Level     The bake casts rays from eyes all around at each level and at the source (SeenErrors). The
///             error depends on the eye: the ray through a surface that is off by d along its normal is off
///             by d / cos; where an edge hides something else, by the distance between the two. Both change
///             slowly with the eye, apart from noise, so the eye's own figure is the mean of its neighbours',
///             weighted by exp(-(angle / spread)^2 / 2). An error is a length, so the placement's scale
///             converts it to the configured prop: the cube root of its volume, since a cell's pose may
///             stretch it.
///   Edges     Where an edge is misplaced, a ray meets what is behind it: a few rays in ten thousand, each
///             with a thousand times the usual error. The hits of one eye's rays predict little about a
///             picture's pixels. The bake therefore measures how far a level's edges move over all eyes
///             together, and combines it with the depth behind the edges that each eye sees
///             (assets_baked/bake/seen_error.cpp).
///   Faces     The bake's rays are evenly spaced; pixels are not. For what the eye sees through it, a face
///             turned to the projector gets up to three times as many pixels as a steep face, and an
///             artifact's parts differ in error. So each patch that an eye saw is weighted by its share of
///             rays times the pixels per square metre (FacePlan::pixels_per_m squared) of the face through
///             which the eye sees the patch.
///   Pixels    32-bit arithmetic displaces what a pixel shows: 0.00015 px in a picture 1920 pixels wide on
///             llvmpipe, which snaps a triangle's edges to a grid of 1/256 pixel but not the attributes of
///             its corners. As a length on the artifact that is the pixel's size there, times the surface's
///             steepness for this eye (SeenEye::steepness). It matters only for the finest levels. A GPU that
///             snaps the attributes too shows 0.0011 px: 1 / (256 sqrt 6) in two directions, of which a place
///             between three corners keeps sqrt(1/2). That is a few micrometres and is ignored.
///   Together  the two errors are independent: their squares add.
///   Older     packs without SeenErrors have only the mean distance D between the surfaces. Over the rays
///             that meet a surface, the mean of d / cos is the sum of d over its visible area, divided by its
///             silhouette: D times visible area over silhouette. That is 2 for a convex body, averaged over
///             all eyes (Cauchy: a silhouette is a quarter of the surface, and half of the surface is
///             visible). The error at edges is left out, so these estimates are too small.
///   Chance    A finest level moves edges by a thousandth of a pixel. The positions of the pixels' centres
///             then decide whether none or three of them show what is behind an edge, and that is half of the
///             mean: no estimate can predict it.
/// Validation    on models that were not used to derive it: `frustumscreen-bench estimate`, docs/bench.md.
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

namespace frustumscreen::scene {

struct ErrorEstimate {
    double mean_mm = 0.0;
    double p95_mm = 0.0;
};

/// One level as seen by eyes all around it.
struct SeenLevel {
    std::vector<pack::SeenEye> eyes; ///< as SeenErrors; one at least
    std::vector<pack::SeenError> errors;
};
/// Estimate for a pack without SeenErrors, with one nominal eye.
[[nodiscard]] SeenLevel derived(const pack::LevelError& error, const glm::dvec3& box_size);
/// For a whole pack: one for each level, and one for each relief, in the order of `reliefs_of`.
struct SeenByEyes {
    std::vector<SeenLevel> levels, reliefs;
};
/// Uses `derived` where the pack has no SeenErrors. Errors: those of seen_errors_of.
[[nodiscard]] Result<SeenByEyes> seen_by_eyes(const pack::PackOutline& pack);

/// The maximum of each figure over all eyes.
[[nodiscard]] pack::SeenError worst_of(const SeenLevel& seen);

/// `plan`: must contain only `level`, for `view`; only the first eye counts.
[[nodiscard]] std::optional<ErrorEstimate> estimate_error(const SeenLevel& seen,
                                                          const geometry::PropShape& prop,
                                                          const PlacedLevel& level, const PlanView& view,
                                                          const FramePlan& plan);

/// The larger of the two in each figure; nothing if neither shows anything.
[[nodiscard]] std::optional<ErrorEstimate> larger(const std::optional<ErrorEstimate>& a,
                                                  const std::optional<ErrorEstimate>& b);

} // namespace frustumscreen::scene
