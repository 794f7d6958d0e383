/// Initial poses of a tag from its four corners alone: two poses, from which a fit to all corners starts.
///
/// Frames   camera C; corners as undistorted directions (X / Z, Y / Z), in the order of FoundTag.
/// Errors   no pose if the corners are not the image of a square.
/// Threads  pure; any.
/// Source   the homography of a square: Heckbert, Fundamentals of texture mapping and image warping, 1989,
///          2.2.3. Two poses: a small square looks almost equal from two sides, mirrored at the line of
///          sight: Schweighofer and Pinz, Robust pose estimation from a planar target, 2006.
#pragma once

#include "app/geometry/transform.h"

#include <array>
#include <optional>

namespace frustumscreen::tags {

/// camera_from_tag from the homography.
[[nodiscard]] std::optional<geometry::RigidTransform> tag_start(const std::array<glm::dvec2, 4>& corners,
                                                                double size_m);
/// The second one of the two poses.
[[nodiscard]] geometry::RigidTransform mirrored(const geometry::RigidTransform& camera_from_tag);

} // namespace frustumscreen::tags
