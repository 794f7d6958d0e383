/// Where a tag may be by its four corners alone: two poses, from which a fit to all corners starts.
///
/// Frames   camera C; corners as directions (X / Z, Y / Z), the lens taken out, in the order of FoundTag.
/// Errors   none of the two: the corners are no picture of a square.
/// Threads  pure; any.
/// Source   the homography of a square: Heckbert, Fundamentals of texture mapping and image warping, 1989, 2.2.3. Two poses: a
///          small square is seen almost alike from two sides, mirrored at the line of sight: Schweighofer and Pinz, Robust pose
///          estimation from a planar target, 2006.
#pragma once

#include "app/geometry/transform.h"

#include <array>
#include <optional>

namespace frustumscreen {

/// camera_from_tag by the homography.
[[nodiscard]] std::optional<RigidTransform> tag_start(const std::array<glm::dvec2, 4>& corners,
                                                      double size_m);
/// The other one of the two.
[[nodiscard]] RigidTransform mirrored(const RigidTransform& camera_from_tag);

} // namespace frustumscreen
