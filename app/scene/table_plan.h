/// The pictures that lie on the table, as draws: before what is drawn in the prop and in windows.
///
/// Frames   as frame_plan.h.
/// Threads  pure; any. Allocates nothing into a plan that make_plan made.
/// Errors   none: a picture outside of the projector's has no draw.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/scene/frame_plan.h"

namespace frustumscreen::scene {

/// Adds the view's pictures to the draws, and then the faces of prop and windows in black, so that no picture lights
/// them; pictures with `on_prop` follow.
void plan_table(const geometry::PropShape& prop, const PlanView& view, FramePlan& plan);

} // namespace frustumscreen::scene
