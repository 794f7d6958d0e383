/// How much of the picture the prop takes: what several samples a pixel need room for.
///
/// Units    pixels.
/// Threads  pure; any.
/// Errors   none.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/prop_shape.h"
#include "app/scene/visibility.h"
#include "app/settings/settings.h"
#include "firmware_host/base/pixel_rectangle.h"

#include <glm/glm.hpp>

#include <optional>

namespace frustumscreen {

/// Pixels around the prop, with one to spare on each side; the whole picture if a corner is not in front of the projector. Clip
/// coordinates as `Pinhole::clip_from_point`.
[[nodiscard]] PixelRectangle prop_bounds(const PropShape& prop, const Pinhole& projector,
                                         const glm::dmat4& clip_from_prop);

/// The size of the largest rectangle around the prop: in the views, if they are known; else of a prop that stands anywhere on the
/// table, turned in any way. Places between those that are tried may take some pixels more, for which there is a margin; a prop that is
/// lifted takes more than that. Nothing for one in the hand, which may fill the picture.
[[nodiscard]] std::optional<PixelSize> largest_outline(const Settings& settings, const Pinhole& projector,
                                                       const Visibility& visibility);

} // namespace frustumscreen
