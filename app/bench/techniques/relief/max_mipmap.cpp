#include "app/bench/techniques/relief/max_mipmap.h"

#include <algorithm>

namespace frustumscreen::bench {

MaxMipmap max_mipmap(image::Image<glm::u16vec2> material) {
    MaxMipmap levels;
    levels.push_back(std::move(material));
    while (levels.back().width > 1) {
        const image::Image<glm::u16vec2>& fine = levels.back();
        image::Image<glm::u16vec2> coarse(fine.width / 2, fine.height / 2);
        for (int y = 0; y < coarse.height; ++y) {
            for (int x = 0; x < coarse.width; ++x) {
                glm::u16vec2 bound(65535, 0);
                for (int k = 0; k < 4; ++k) {
                    const glm::u16vec2& child = fine.at(2 * x + k % 2, 2 * y + k / 2);
                    bound = {std::min(bound.x, child.x), std::max(bound.y, child.y)};
                }
                coarse.at(x, y) = bound;
            }
        }
        levels.push_back(std::move(coarse));
    }
    return levels;
}

} // namespace frustumscreen::bench
