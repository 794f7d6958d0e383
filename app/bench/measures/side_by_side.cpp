#include "app/bench/measures/side_by_side.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen::bench {

PixelRectangle box_of(const image::Image<std::uint8_t>& mask) {
    constexpr int rim = 2;
    PixelRectangle box;
    for (int y = 0; y < mask.height; ++y) {
        for (int x = 0; x < mask.width; ++x) {
            if (mask.at(x, y) != 0) {
                box = united(box, {.x = x - rim, .y = y - rim, .width = 2 * rim + 1, .height = 2 * rim + 1});
            }
        }
    }
    return intersected(box, {.x = 0, .y = 0, .width = mask.width, .height = mask.height});
}

image::Image8 side_by_side(std::span<const image::Image8* const> pictures, const PixelRectangle& part) {
    constexpr int large_px = 480;
    const int enlarged = std::clamp(large_px / std::max({1, part.width, part.height}), 1, 8);
    const int width = enlarged * part.width;
    image::Image8 made(static_cast<int>(pictures.size()) * width, enlarged * part.height);
    for (int y = 0; y < made.height; ++y) {
        for (int x = 0; x < made.width; ++x) {
            const image::Image8& picture = *pictures[static_cast<std::size_t>(x / width)];
            made.at(x, y) = picture.at(part.x + x % width / enlarged, part.y + y / enlarged);
        }
    }
    return made;
}

image::Image8 error_picture(const TruthPicture& truth, const Drawn& drawn) {
    image::Image8 wrong(truth.hit.width, truth.hit.height, glm::u8vec4(0, 0, 0, 255));
    image::Image<std::uint8_t> either = truth.hit;
    for (std::size_t k = 0; k < wrong.texels.size(); ++k) {
        const glm::vec3& point = drawn.point_m.texels[k];
        const bool shown = !std::isnan(point.x);
        const bool hit = truth.hit.texels[k] != 0;
        either.texels[k] = shown || hit ? 1 : 0;
        if (shown != hit) {
            wrong.texels[k] = {255, 40, 30, 255};
        } else if (hit) {
            const float mm = 1e3F * glm::distance(point, truth.point_m.texels[k]);
            const auto grey = static_cast<std::uint8_t>(24.0F + std::min(1.0F, mm / white_mm) * 231.0F);
            wrong.texels[k] = {grey, grey, grey, 255};
        }
    }
    return side_by_side(std::array{&truth.colour16, &drawn.colour, static_cast<const image::Image8*>(&wrong)},
                        box_of(either));
}

} // namespace frustumscreen::bench
