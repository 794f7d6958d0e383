/// The shaders that a scene's pictures need, and the samples a pixel.
///
/// Threads  pure; any.
/// Errors   none.
#pragma once

#include "app/scene/scene_plan.h"

namespace frustumscreen::scene {

/// From the plan's quality levels, levels, reliefs and captions. Adds what is left out, and why. `signs`: pictures other than
/// captions lie on the table.
void choose_shaders(const SceneRequest& request, bool signs, ScenePlan& plan);

} // namespace frustumscreen::scene
