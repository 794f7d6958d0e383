/// A flat screen as an output: the surface that it lights is the panel itself.
///
/// The surface has one face, the lit area. The pinhole looks straight at it from the front, and its picture is the lit area:
/// it maps each point of the panel to the pixel that lights it. So the code that draws a projector's picture on a prop draws a
/// screen's picture too, without light compensation: a panel is equally bright everywhere.
///
/// Frames   table T; metres. The surface's face looks towards the people before the screen.
/// Threads  pure; any.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/prop_shape.h"
#include "app/geometry/transform.h"

#include <glm/glm.hpp>

#include <array>

namespace frustumscreen::scene {

struct FlatScreen {
    geometry::PropShape surface; ///< one face, "screen"
    geometry::Pinhole pinhole;
    geometry::RigidTransform table_from_pinhole;
};

/// `corners_m`: of a rectangle, top left, top right, bottom right, bottom left. `width`, `height`: pixels.
[[nodiscard]] FlatScreen flat_screen(const std::array<glm::dvec3, 4>& corners_m, int width, int height);

} // namespace frustumscreen::scene
