/// Position of a head from its outline.
///
/// Model    an upright ellipse 1.3 times as high as wide, seen through the camera's lens: its centre and
///          width are fitted to the outline, by Gauss-Newton with a robust loss (Huber). The centre gives the
///          head's direction. Its distance follows from its apparent width, since heads with their hair vary
///          by a tenth, and from where people stand at a table.
/// Frames   table T, metres.
/// Threads  pure; any.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/transform.h"
#include "app/visitor/head_outline.h"
#include "app/visitor/head_zone.h"

#include <optional>

namespace frustumscreen::visitor {

struct FittedHead {
    glm::dvec3 middle_m{0.0}; ///< of the head with its hair
    double across_sd_m = 0.0; ///< across the camera's ray, on each axis
    double along_sd_m = 0.0;  ///< along it
    glm::dvec2 pixel{0.0};    ///< of the centre, in the outline's frame
    double width_px = 0.0;
};

/// `camera`: that of the outline's frame. nullopt: not a head, or not at the table.
[[nodiscard]] std::optional<FittedHead> fit_head(const HeadOutline& outline, const geometry::Pinhole& camera,
                                                 const geometry::RigidTransform& table_from_camera,
                                                 const HeadZone& zone);

} // namespace frustumscreen::visitor
