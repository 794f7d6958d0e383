/// Worlds for tests of layered depth images, whose surfaces have one colour each.
///
/// Frames   window (app/ldi/triangle_world.h).
/// Threads  pure; any.
#pragma once

#include "app/ldi/triangle_world.h"

namespace frustumscreen::ldi {

/// Parallel to the window.
void add_rectangle(TriangleWorld& world, const glm::vec3& middle, const glm::vec2& half_extent_m,
                   const glm::u8vec3& colour);
void add_sphere(TriangleWorld& world, const glm::vec3& middle, float radius_m, const glm::u8vec3& colour);

/// A wall and eleven spheres before it, one of them before the window.
[[nodiscard]] TriangleWorld spheres_before_a_wall();

} // namespace frustumscreen::ldi
