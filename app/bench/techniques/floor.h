/// The floor: what the plainest picture on the prop costs, the unit of every frame time. A picture that
/// leaves most of a face dark may cost less.
///
/// The same prop and pixels as the exhibit's picture, each face that it would light one 1024 x 1024 trilinear
/// texture of its own colour format; the same clear, always a full redraw; the caller calls glFinish.
///
/// Threads  the one whose context is current; the stage must outlive the technique.
/// Errors   at creation only: the driver refuses a shader or has no memory.
#pragma once

#include "app/bench/techniques/technique.h"

#include <memory>

namespace frustumscreen {

/// Its hit points are all NaN: it shows no artifact.
[[nodiscard]] Result<std::unique_ptr<Technique>> make_floor(const Stage& stage);

} // namespace frustumscreen
