/// The part of a picture that torches light: which of its draws, in which pixels, and the view of each torch.
///
/// A torch's own picture is one of a flat surface with one face close before it, drawn by the pinhole of its beam; so
/// `plan_frame` plans it too. Its depth tells the places that the torch sees from those in shadow.
///
/// Frames   as frame_plan.h; torch: torch/torch.h.
/// Threads  pure; any. Allocates nothing into a plan that was made with space for torches.
#pragma once

#include "app/geometry/collineation.h"
#include "app/scene/frame_plan.h"

#include <span>

namespace frustumscreen::scene {

/// Makes space in a plan for torches that light `parts` parts of `indices` indices together.
void make_torch_space(FramePlan& plan, std::size_t faces, std::size_t indices, std::size_t parts);

/// True if the depth of all that a torch's own picture shows is found on the processor: polygons without holes, and reliefs that
/// the GPU does not draw. `view`: one of FramePlan::torch_views.
[[nodiscard]] bool is_found_on_processor(const FramePlan& view);

/// Adds the view's torches to a plan of the same parts of `prop`. `box`: around all parts, prop frame.
///
/// A world that reaches out of the prop casts shadows only behind the face that is farthest from the torch, because the faces cut off
/// the rest. Where that face cuts an object open, light within the object lights nothing. A layer does not show. A world whose textures
/// have holes casts shadows as a whole.
void plan_torches(const geometry::PropShape& prop, std::span<const Part> parts, const PlanView& view,
                  const geometry::Box& box, FramePlan& plan);

} // namespace frustumscreen::scene
