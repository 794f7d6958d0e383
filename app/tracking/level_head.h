/// The turn of a head whose own is not measured: level, and turned to what the visitor looks at.
///
/// Frame    table T.
/// Threads  pure; any.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace frustumscreen::tracking {

/// table_from_head: +Z up, +Y along the table towards `looked_at_m`. A head straight above that point looks along +Y.
[[nodiscard]] glm::dquat level_head(const glm::dvec3& eye_m, const glm::dvec3& looked_at_m);

} // namespace frustumscreen::tracking
