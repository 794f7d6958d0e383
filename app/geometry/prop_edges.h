/// Finds the faces of the prop that meet at an edge.
///
/// Threads  pure; any.
#pragma once

#include "app/geometry/prop_shape.h"

namespace frustumscreen::geometry {

/// The face on the other side of the edge from corner `k` of `face`, one of the prop's, to the next corner;
/// null if it is never lit.
[[nodiscard]] const PropFace* neighbour_of(const PropShape& prop, const PropFace& face, std::size_t k);

} // namespace frustumscreen::geometry
