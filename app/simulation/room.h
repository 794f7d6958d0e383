/// A table in its room, for a picture that illustrates an exhibit: table, legs, floor, wall, and the
/// projector above.
///
/// Frames   table T, metres.
/// Threads  pure; any.
#pragma once

#include "app/simulation/visitor_view.h"

#include <vector>

namespace frustumscreen::simulation {

/// The stand of a screen, from the floor to its middle, behind it; a screen that leans is not held at each place.
[[nodiscard]] std::vector<RoomObject> stand_of(const VisitorScreen& screen);

/// `lens_m`: the projector's position.
[[nodiscard]] std::vector<RoomObject> room_around(const glm::dvec2& table_size_m, const glm::dvec3& lens_m);

} // namespace frustumscreen::simulation
