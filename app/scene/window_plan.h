/// Plans pinned windows in a picture. Each is planned as a prop of one face (`plan_frame`), into a plan of its own, so the prop's
/// samples, tiles and light stay as they are.
///
/// Fade     a window of one part fades from it to points; several parts are drawn up to half of the fade.
/// Cover    the prop is nearer to the projector than the table is. Where its outline in the picture, a pixel wider, meets a
///          window, the window is not drawn.
/// Frames   as frame_plan.h.
/// Threads  pure; any. Allocates nothing into a plan that was made with space for windows.
/// Errors   none: a window that the eye sees from behind, or that the projector does not light, shows nothing.
#pragma once

#include "app/scene/frame_plan.h"

#include <cstddef>

namespace frustumscreen::scene {

/// Makes space in a plan for `windows` windows of at most `parts` parts that have at most `indices` indices together.
/// `torches`: that may be lit.
void make_window_space(FramePlan& plan, std::size_t windows, std::size_t indices, std::size_t parts,
                       bool torches = false);

/// Plans the view's windows. Those for which the plan has no space are left out.
void plan_windows(const geometry::PropShape& prop, const PlanView& view, FramePlan& plan);

} // namespace frustumscreen::scene
