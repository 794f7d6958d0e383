#include "app/image/light_mips.h"
#include "app/image/row_shrinker.h"

#include <algorithm>
#include <span>

namespace frustumscreen::image {

Image8 half_size(const Image8& image) {
    RowShrinker half({image.width, image.height}, 1);
    const std::span<const glm::u8vec4> texels(image.texels);
    const auto width = static_cast<std::size_t>(image.width);
    for (std::size_t begin = 0; begin < texels.size(); begin += width) {
        half.add(texels.subspan(begin, width));
    }
    return half.take();
}

std::vector<Image8> light_mips(const Image8& picture) {
    std::vector<Image8> mips{picture};
    for (glm::u8vec4& texel : mips.front().texels) {
        const double covered = texel.a / 255.0;
        for (int k = 0; k < 3; ++k) {
            texel[k] = srgb8_from_linear(covered * static_cast<double>(linear_from_srgb8()[texel[k]]));
        }
        texel.a = 255;
    }
    while (std::max(mips.back().width, mips.back().height) > 1) {
        mips.push_back(half_size(mips.back()));
    }
    return mips;
}

} // namespace frustumscreen::image
