/// A world that reaches out of the prop (PlacedLevel::beyond): each face is a window into it.
///
/// Frames   prop; metres.
/// Threads  pure; any. Allocates nothing.
/// Errors   none.
#pragma once

#include "app/geometry/collineation.h"
#include "app/geometry/prop_shape.h"
#include "app/scene/frame_plan.h"

#include <glm/glm.hpp>

namespace frustumscreen::scene {

/// Around the prop.
[[nodiscard]] geometry::Box box_around(const geometry::PropShape& prop);

/// The half space behind a face, as FaceVolume has them, in the frame of `prop_from_frame`.
[[nodiscard]] glm::dvec4 half_space_behind(const geometry::PropFace& face, const glm::dmat4& prop_from_frame);

/// The place of a level's box that is nearest to a point of the prop, box units.
[[nodiscard]] glm::dvec3 nearest_in_box(const PlacedLevel& level, const glm::dmat4& placed_from_prop,
                                        const glm::dvec3& in_prop);

/// Pixels that the part takes at most, by its box's silhouette and the prop's (cell_plan.h); 0 only if no face shows any of its
/// box. For the eye and the projector of the view.
[[nodiscard]] double pixels_beyond(const PlacedLevel& level, const geometry::PropShape& prop,
                                   const PlanView& view);

} // namespace frustumscreen::scene
