/// Packs rectangles into one picture.
///
/// Units    texels.
/// Threads  pure; any.
/// Method   skyline, bottom-left, tallest first (Jylanki 2010).
#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace frustumscreen::bake {

struct AtlasLayout {
    int width = 0;
    int height = 0;
    std::vector<glm::ivec2> corners; ///< top-left of each rectangle, in the given order
};

/// The picture is about square. A size is at least 1 x 1, or 0 x 0 for an empty rectangle.
[[nodiscard]] AtlasLayout pack_rectangles(const std::vector<glm::ivec2>& sizes);

} // namespace frustumscreen::bake
