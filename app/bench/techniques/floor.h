/// The floor: the cost of the plainest picture on the prop, the unit of every frame time. A picture that
/// leaves most of a face dark may cost less.
///
/// It draws the exhibit's prop and pixels: each face that the exhibit would light gets one 1024 x 1024
/// texture, whose codes are written unchanged: nothing decodes or encodes sRGB. Only colour is cleared, as in
/// the exhibit. Which filter is faster depends on the machine: both are timed, and the faster is the unit.
/// Always a full redraw; the caller calls glFinish.
///
/// Threads  the one whose context is current; the kiosk must outlive the technique.
/// Errors   at creation only: the driver refuses a shader or has no memory.
#pragma once

#include "app/bench/techniques/technique.h"

#include <memory>

namespace frustumscreen::bench {

enum class FloorFilter {
    Trilinear,
    OneLevel, ///< bilinear, from the mip level with texels of about one pixel, chosen per face
};

/// Its hit points are all NaN because it shows no artifact.
[[nodiscard]] Result<std::unique_ptr<Technique>> make_floor(const Kiosk& kiosk, FloorFilter filter);

} // namespace frustumscreen::bench
