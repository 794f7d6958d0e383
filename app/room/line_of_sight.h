/// Which object the prop is before, as the eye sees it: the line from the eye through the prop's middle meets its box.
///
/// Frames   table T; metres.
/// Threads  pure; any. Allocates nothing.
/// Errors   none: an eye in the prop's middle looks nowhere.
#pragma once

#include "app/room/room.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace frustumscreen::room {

/// An object that can be met.
struct SeenObject {
    std::size_t object = 0;   ///< index into Room::objects
    glm::dvec3 box_size{1.0}; ///< of its pack; the longest edge is 1
};

struct Line {
    glm::dvec3 from_m{0.0};
    glm::dvec3 through_m{0.0}; ///< only what lies beyond counts
};

/// True if the line goes through a rectangle, such as the screen that shows what lies on the line. `corners_m`: top left, top
/// right, bottom right, bottom left.
[[nodiscard]] bool goes_through(const Line& line, const std::array<glm::dvec3, 4>& corners_m);

/// How much larger than its box an object is for a line that met it before, so that a trembling hand does not lose it.
inline constexpr double held_size = 1.3;

/// Distance from the eye in units of that to `through_m`, 1 or more, at which the line enters the object's box, `grown` as
/// large about its middle; nothing: it passes by.
[[nodiscard]] std::optional<double> meets(const Line& line, const Object& object, const glm::dvec3& box_size,
                                          double seconds, double grown = 1.0);

/// The nearest object that the line meets, index into `seen`. `before`: the object, index into Room::objects, that it met
/// before.
[[nodiscard]] std::optional<std::size_t> first_met(const Line& line, std::span<const Object> objects,
                                                   std::span<const SeenObject> seen, double seconds,
                                                   const std::optional<std::size_t>& before);

} // namespace frustumscreen::room
