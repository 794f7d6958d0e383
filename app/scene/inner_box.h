/// A box inside the solid that a closed mesh bounds: an occluder for everything behind it.
///
/// Closed   each edge is shared by triangles that run along it in opposite directions; otherwise there is no box. The solid is
///          where the surface winds around a point, seen from outside counter-clockwise.
/// Method   a grid of 32 x 32 x 32 cells. A cell is solid if no triangle touches it and the surface winds around its
///          middle. The box is the largest one of solid cells, in the best of six grids that are turned about z.
///
/// Frames   that of the positions.
/// Threads  pure; any. Never in a frame: it takes some milliseconds for ten thousand triangles.
#pragma once

#include "app/scene/room_culling.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <span>

namespace frustumscreen::scene {

[[nodiscard]] std::optional<BoxCorners> inner_box(std::span<const glm::vec3> positions,
                                                  std::span<const std::uint32_t> indices);

} // namespace frustumscreen::scene
