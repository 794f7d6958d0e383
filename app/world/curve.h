/// The value of a curve at a time, and the blend of two values.
///
/// Values   four numbers as in Curve::values: a rotation is a unit quaternion x, y, z, w; of the others the first three
///          count.
/// Errors   none: before the first key, and for a time that is not a number, the first key's value. A rotation of no
///          length is left as the nearer key's, or as none at all.
/// Threads  pure; any. Nothing allocates.
/// Source   Khronos, glTF 2.0, appendix C: step, linear, spherical linear, cubic spline.
#pragma once

#include "app/world/behaviour.h"

#include <glm/glm.hpp>

namespace frustumscreen::world {

/// `curve` has at least one key, and as many values as its interpolation needs.
[[nodiscard]] glm::dvec4 value_at(const Curve& curve, Path path, double seconds);

/// `share`: 0 is `from`, 1 is `to`. Rotations turn the shorter way at a constant speed.
[[nodiscard]] glm::dvec4 blend(Path path, const glm::dvec4& from, const glm::dvec4& to, double share);

} // namespace frustumscreen::world
