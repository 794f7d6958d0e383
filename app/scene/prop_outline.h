/// The part of the picture that the prop covers, for which several samples a pixel need memory.
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

namespace frustumscreen::scene {

/// Pixels around the prop, with a margin of one on each side; the whole picture if a corner is not in front
/// of the projector. Clip coordinates as `Pinhole::clip_from_point`.
[[nodiscard]] PixelRectangle prop_bounds(const geometry::PropShape& prop, const geometry::Pinhole& projector,
                                         const glm::dmat4& clip_from_prop);

/// Size of the largest rectangle around the prop: in the views, if they are known; otherwise for a prop that
/// stands anywhere on the table at any yaw. A margin covers places between those that are sampled; a lifted
/// prop may exceed it. nullopt for a prop in the hand, which may fill the picture.
[[nodiscard]] std::optional<PixelSize> largest_outline(const settings::Settings& settings,
                                                       const geometry::Pinhole& projector,
                                                       const Visibility& visibility);

} // namespace frustumscreen::scene
