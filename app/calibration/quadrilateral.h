/// The pixels of a picture inside a quadrilateral of either orientation.
///
/// Units    pixels, the centre of the top left one is (0.5, 0.5).
/// Threads  pure; any.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstddef>

namespace frustumscreen::calibration {

using Quadrilateral = std::array<glm::dvec2, 4>;

[[nodiscard]] inline bool is_inside(const Quadrilateral& corners, const glm::dvec2& place) {
    int left = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const glm::dvec2 side = corners[(k + 1) % 4] - corners[k];
        const glm::dvec2 to = place - corners[k];
        left += side.x * to.y - side.y * to.x > 0.0 ? 1 : 0;
    }
    return left == 0 || left == 4;
}

/// Calls `use(index, centre)` for each pixel whose centre is inside, row by row.
void for_each_pixel(const Quadrilateral& corners, int width, int height, const auto& use) {
    const glm::dvec2 size(width, height);
    glm::dvec2 low = size;
    glm::dvec2 high(0.0);
    for (const glm::dvec2& corner : corners) {
        low = glm::min(low, glm::clamp(corner, glm::dvec2(0.0), size));
        high = glm::max(high, glm::clamp(glm::ceil(corner), glm::dvec2(0.0), size));
    }
    for (int y = static_cast<int>(low.y); y < static_cast<int>(high.y); ++y) {
        for (int x = static_cast<int>(low.x); x < static_cast<int>(high.x); ++x) {
            if (const glm::dvec2 centre(x + 0.5, y + 0.5); is_inside(corners, centre)) {
                use(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                        static_cast<std::size_t>(x),
                    centre);
            }
        }
    }
}

} // namespace frustumscreen::calibration
