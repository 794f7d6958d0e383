/// The colour of a triangle of a world where a ray meets it.
///
/// Frames   the world's (triangle_world.h).
/// Colour   8-bit sRGB; the last component is the coverage of a cut-out.
/// Threads  pure; any.
#pragma once

#include "app/ldi/triangle_world.h"

#include <glm/glm.hpp>

#include <cstdint>

namespace frustumscreen::ldi {

/// The ray's end need not reach the triangle. Beside the triangle, the colour of a near place of its border. The triangle's
/// indices must be valid. White where the world has neither colours nor a texture.
[[nodiscard]] glm::u8vec4 surface_colour(const TriangleWorld& world, std::uint32_t triangle,
                                         const glm::dvec3& eye, const glm::dvec3& ray);

/// True if it is not a hole of a cut-out.
[[nodiscard]] inline bool is_solid(const glm::u8vec4& colour) {
    return colour.a >= 128;
}

} // namespace frustumscreen::ldi
