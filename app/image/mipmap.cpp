#include "app/image/light_mips.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::image {

namespace {

/// The texels of one row or column that a texel of half the size covers, and the share of each.
struct Covered {
    int first = 0;
    int count = 0;
    std::array<float, 3> share{};
};

std::vector<Covered> coverage(int size, int half) {
    std::vector<Covered> covered(static_cast<std::size_t>(half));
    const double span = static_cast<double>(size) / half; // 2, or up to 3 if the size is odd
    for (int k = 0; k < half; ++k) {
        Covered& c = covered[static_cast<std::size_t>(k)];
        const double begin = k * span;
        const double end = begin + span;
        c.first = static_cast<int>(begin);
        for (int t = c.first; t < size && t < end && c.count < 3; ++t) {
            const double part = std::fmin(end, t + 1.0) - std::fmax(begin, t);
            c.share[static_cast<std::size_t>(c.count++)] = static_cast<float>(part / span);
        }
    }
    return covered;
}

/// A table of the nearest sRGB code of linear light; its steps are a twentieth of a code where codes are
/// closest, near black.
std::vector<std::uint8_t> code_table(std::size_t entries) {
    std::vector<std::uint8_t> codes(entries);
    for (std::size_t k = 0; k < entries; ++k) {
        codes[k] = srgb8_from_linear(static_cast<double>(k) / static_cast<double>(entries - 1));
    }
    return codes;
}

} // namespace

Image8 half_size(const Image8& image) {
    const int width = std::max(1, image.width / 2);
    const int height = std::max(1, image.height / 2);
    constexpr std::size_t entries = 1U << 16U;
    static const std::vector<std::uint8_t> codes = code_table(entries);
    const std::array<float, 256>& linear = linear_from_srgb8();
    const std::vector<Covered> columns = coverage(image.width, width);
    const std::vector<Covered> rows = coverage(image.height, height);
    Image8 half(width, height);
    for (int y = 0; y < height; ++y) {
        const Covered& row = rows[static_cast<std::size_t>(y)];
        for (int x = 0; x < width; ++x) {
            const Covered& column = columns[static_cast<std::size_t>(x)];
            glm::vec4 sum(0.0F);
            for (int j = 0; j < row.count; ++j) {
                for (int i = 0; i < column.count; ++i) {
                    const glm::u8vec4& texel = image.at(column.first + i, row.first + j);
                    const float share =
                        row.share[static_cast<std::size_t>(j)] * column.share[static_cast<std::size_t>(i)];
                    sum += share * glm::vec4(linear[texel.r], linear[texel.g], linear[texel.b],
                                             static_cast<float>(texel.a));
                }
            }
            const auto code = [&](float light) {
                const float place = std::clamp(light, 0.0F, 1.0F) * static_cast<float>(entries - 1);
                return codes[static_cast<std::size_t>(std::lround(place))];
            };
            half.at(x, y) = {code(sum.r), code(sum.g), code(sum.b),
                             static_cast<std::uint8_t>(std::lround(std::clamp(sum.a, 0.0F, 255.0F)))};
        }
    }
    return half;
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
