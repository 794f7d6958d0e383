/// A solid as the shape of a prop.
///
/// Frame    the solid's, which is the prop's: it stands on z = 0, and its axis x = y = 0 runs through it
///          (prop_file.h). Metres.
/// Threads  pure; any.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/solid/solid.h"

#include <cstdint>

namespace frustumscreen::solid {

/// The face on z = 0, if there is one: dark under a prop that stands on the table, lit under one in the hand.
enum class Underside : std::uint8_t { Dark, Lit };

/// Faces are in the solid's order, with its names.
[[nodiscard]] geometry::PropShape shape_of(const Solid& solid, Underside underside);

} // namespace frustumscreen::solid
