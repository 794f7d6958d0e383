#include "assets_baked/artifacts/atlas.h"

#include "firmware_host/base/parallel.h"

#include <algorithm>

namespace frustumscreen::artifacts {

glm::u8vec4 texel_of(const glm::vec3& srgb01) {
    return {glm::u8vec3(glm::clamp(srgb01, 0.0F, 1.0F) * 255.0F + 0.5F), 255};
}

void paint_strip(const AtlasStrip& strip, image::Image8& texture,
                 const std::function<glm::vec3(float u, float v)>& colour) {
    constexpr int margin_rows = 4;
    const int rows = std::min(strip.rows + margin_rows, texture.height - strip.first_row);
    parallel_for(static_cast<std::size_t>(rows), 1, [&](std::size_t begin, std::size_t) {
        const int row = static_cast<int>(begin);
        const float v = static_cast<float>(row) / static_cast<float>(strip.rows - 1);
        for (int x = 0; x < texture.width; ++x) {
            const float u = (static_cast<float>(x) + 0.5F) / static_cast<float>(texture.width);
            texture.at(x, strip.first_row + row) = texel_of(colour(u, v));
        }
    });
}

} // namespace frustumscreen::artifacts
