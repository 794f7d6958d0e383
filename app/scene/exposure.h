/// Exposure of an artifact: a factor that brings its brightest places to a set code, whatever the scanner's
/// exposure.
///
/// Units    sRGB codes; the factor applies to linear light.
/// Threads  pure; any.
/// Errors   none: a level without triangles has the factor 1.
/// Source   IEC 61966-2-1 for the codes.
#pragma once

#include "app/image/image.h"
#include "app/pack/pack.h"

namespace frustumscreen::scene {

/// Limit for artifacts so dark that noise hides their brightest places.
inline constexpr double max_exposure = 8.0;

/// The factor that brings the level's brightest places to `highlight_code` where the compensation's gain is
/// 1: 98 % of its surface, by area, have no channel above that code. 1 if `highlight_code` is 0. `box_size`:
/// as Pack::box_size.
[[nodiscard]] double exposure_of(const pack::PackLevel& level, const glm::dvec3& box_size,
                                 const image::Image8& texture, int highlight_code);

} // namespace frustumscreen::scene
