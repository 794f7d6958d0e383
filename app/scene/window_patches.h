/// The world behind a frozen window, as points for the eyes before it: drawn in place of its triangles or relief, in less time.
///
/// Frames   window: as PlacedWindow.
/// Units    metres.
/// Threads  values; any.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/ldi/hemisphere.h"
#include "app/ldi/point_patch.h"
#include "app/scene/frame_plan.h"
#include "app/scene/shader_key.h"

#include <glm/glm.hpp>

#include <array>

namespace frustumscreen::scene {

struct WindowPatches {
    ldi::Hemisphere hemisphere;
    geometry::Box box;                                              ///< around the world
    int samples = 1;                                                ///< a pixel
    std::array<const ldi::PointPatch*, ldi::patch_count> patches{}; ///< null: not made
};

/// Null if there are no points for an eye, window's frame: its patch is not made, or it is too near or far (ldi/eye_cells.h).
[[nodiscard]] const ldi::PointPatch* points_for(const WindowPatches& patches, const glm::dvec3& eye);

/// The patch as a part of the window's world.
[[nodiscard]] Part part_of(const WindowPatches& patches, const ldi::PointPatch& points);

/// Adds to a renderer's needs those of drawing points.
[[nodiscard]] RenderNeeds with_points(RenderNeeds needs);

} // namespace frustumscreen::scene
