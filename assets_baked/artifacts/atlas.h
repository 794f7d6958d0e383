/// A texture atlas of horizontal strips, and the function that paints one.
///
/// Shape    row 0 at the top; a strip spans the whole width, so that u may wrap around.
/// Threads  `paint_strip` uses all cores; the result does not depend on their number.
#pragma once

#include "app/image/image.h"

#include <glm/glm.hpp>

#include <functional>

namespace frustumscreen::artifacts {

/// Rows of the atlas for one part of the surface.
struct AtlasStrip {
    int first_row = 0;
    int rows = 0;
    [[nodiscard]] float v(double fraction, int atlas_rows) const { ///< 0 at the middle of the first row
        return static_cast<float>((first_row + 0.5 + fraction * (rows - 1)) / atlas_rows);
    }
};

[[nodiscard]] glm::u8vec4 texel_of(const glm::vec3& srgb01);

/// colour(u, v): v from 0 in the first row to 1 in the last. Some rows beyond the strip are filled too, so
/// that filtering keeps the edge clean.
void paint_strip(const AtlasStrip& strip, image::Image8& texture,
                 const std::function<glm::vec3(float u, float v)>& colour);

} // namespace frustumscreen::artifacts
