#include "app/image/light_mips.h"
#include "app/image/row_shrinker.h"

#include <algorithm>
#include <span>
#include <utility>

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

namespace {

Image8 over_black(Image8 picture) {
    for (glm::u8vec4& texel : picture.texels) {
        const double covered = texel.a / 255.0;
        for (int k = 0; k < 3; ++k) {
            texel[k] = srgb8_from_linear(covered * static_cast<double>(linear_from_srgb8()[texel[k]]));
        }
    }
    return picture;
}

std::vector<Image8> mips_of(Image8 picture) {
    std::vector<Image8> mips{std::move(picture)};
    while (std::max(mips.back().width, mips.back().height) > 1) {
        mips.push_back(half_size(mips.back()));
    }
    return mips;
}

} // namespace

std::vector<Image8> light_mips(const Image8& picture) {
    Image8 light = over_black(picture);
    for (glm::u8vec4& texel : light.texels) {
        texel.a = 255;
    }
    return mips_of(std::move(light));
}

std::vector<Image8> cut_out_mips(const Image8& picture) {
    return mips_of(over_black(picture));
}

} // namespace frustumscreen::image
