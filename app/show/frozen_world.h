/// The triangles behind a frozen window, from the levels that it froze.
///
/// Frames   window: as scene::PlacedWindow.
/// Units    metres.
/// Threads  pure; any.
/// Errors   none.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/image/image.h"
#include "app/ldi/triangle_world.h"
#include "app/scene/scene_level.h"

#include <glm/glm.hpp>

#include <vector>

namespace frustumscreen::show {

/// One world for each level, because each has its own texture.
struct FrozenWorld {
    std::vector<ldi::TriangleWorld> worlds;
    geometry::Box box{};
};

/// Adds a level. `texture`: its whole texture. `samples_per_m`: of the window's picture, where the level stands: of the texture's mip
/// levels it takes the one whose texels are as large.
void add_level(const scene::SceneLevel& level, const image::Image8& texture, const glm::dvec3& box_size,
               const glm::dmat4& window_from_box, double samples_per_m, FrozenWorld& world);

} // namespace frustumscreen::show
