/// The scene plan of a cell: that of an artifact, but placed by the artifact that the cell is part of.
///
/// Frames   prop; the cell's box as placed (PlacedLevel).
/// Units    metres.
/// Threads  pure; any.
/// Errors   as plan_scene.
#pragma once

#include "app/scene/frame_plan.h"
#include "app/scene/scene_plan.h"
#include "app/world/cell.h"

#include <string>
#include <string_view>

namespace frustumscreen::scene {

/// Scale of a cell's own box while nothing moves: its longest edge, metres. `at_rest`: its pose then.
[[nodiscard]] double metres_per_box_of(const world::CellPose& at_rest, double artifact_metres_per_box);

/// Moves a placed cell to a pose; `level.metres_per_box` is that of the cell.
void set_pose(PlacedLevel& level, const world::CellPose& pose, double artifact_metres_per_box);

/// A technique for an artifact as one of its cells can draw it, which has fewer levels and other reliefs: a level or relief
/// that the cell lacks becomes its finest one; without any relief the cell's default level.
[[nodiscard]] std::string cell_technique(std::string_view technique, const pack::PackOutline& cell);

/// `whole`: the artifact's own plan; `request`: the same request. If a governor may choose, the plan has every level and
/// every relief of the cell (CellChoice), not only those that are good enough. A cell may turn any side to the eye, so none of its
/// triangles and no detail is left out.
[[nodiscard]] Result<ScenePlan> plan_cell(const settings::Settings& settings, const pack::PackOutline& cell,
                                          const ScenePlan& whole, const world::CellPose& at_rest,
                                          SceneRequest request);

/// Pixels that a part takes in the projector's picture, for the work and the weight of a cell among others: its box's
/// silhouette, averaged over all directions (Cauchy: a quarter of the surface).
[[nodiscard]] double pixels_of(const PlacedLevel& level, const PlanView& view);

} // namespace frustumscreen::scene
