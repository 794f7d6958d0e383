/// The world behind a window when it is frozen, as triangles.
///
/// Frames   window: metres; origin in the window's middle, x to the right, y away from the viewer (up in the window's
///          picture), z the normal towards the viewers. An eye has z > 0; the world lies mostly at z < 0, but may reach
///          before the window.
/// Shape    `indices`: three for each triangle, counter-clockwise as its front is seen. `texture_places`: (0, 0) is the
///          texture's upper left corner, (1, 1) the lower right one; beyond, it repeats.
/// Colour   8-bit sRGB, interpolated as codes. The last component is the coverage of a cut-out.
/// Errors   none: a triangle with an index beyond the positions, or with a corner that is not finite, is not drawn.
/// Threads  a value; any.
#pragma once

#include "app/image/image.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace frustumscreen::ldi {

struct TriangleWorld {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    std::vector<glm::u8vec4> colours; ///< one per position; empty: the texture's
    std::vector<glm::vec2> texture_places;
    std::shared_ptr<const image::Image8> texture;
    bool cut_out = false;   ///< where the last component is below one half is a hole
    bool one_sided = false; ///< backs are not shown

    [[nodiscard]] std::size_t triangle_count() const { return indices.size() / 3; }
};

} // namespace frustumscreen::ldi
