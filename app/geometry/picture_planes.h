/// The planes through the lens and the edges of a picture: a point inside all four is in the picture.
///
/// A lens that distorts bends the edges. The planes then bound a convex region inside the picture.
///
/// Frame    pinhole; or another one, by the pinhole's pose.
/// Threads  pure; any.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/prop_shape.h"
#include "app/geometry/transform.h"

#include <array>

namespace frustumscreen::geometry {

/// Normals point into the picture: top, right, bottom, left.
[[nodiscard]] std::array<Plane, 4> picture_planes(const Pinhole& pinhole,
                                                  const RigidTransform& to_from_pinhole);

} // namespace frustumscreen::geometry
