// Pictures that are halved while their rows arrive, against areas that are added up in 64 bits.

#include "app/image/row_shrinker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <span>

namespace frustumscreen::image {
namespace {

Image8 random_picture(int width, int height, std::uint32_t seed) {
    std::mt19937 random(seed);
    Image8 picture(width, height);
    for (glm::u8vec4& texel : picture.texels) {
        for (int k = 0; k < 4; ++k) {
            texel[k] = static_cast<std::uint8_t>(random() % 256);
        }
    }
    return picture;
}

/// The length that [begin, end) and [place, place + 1) share.
double overlap(double begin, double end, int place) {
    return std::max(0.0, std::min(end, place + 1.0) - std::max(begin, static_cast<double>(place)));
}

/// Each texel of the half is the mean of its rectangle of the whole.
Image8 half_by_areas(const Image8& whole) {
    Image8 half(std::max(1, whole.width / 2), std::max(1, whole.height / 2));
    const double across = static_cast<double>(whole.width) / half.width;
    const double down = static_cast<double>(whole.height) / half.height;
    for (int y = 0; y < half.height; ++y) {
        for (int x = 0; x < half.width; ++x) {
            glm::dvec4 sum(0.0);
            for (int v = 0; v < whole.height; ++v) {
                for (int u = 0; u < whole.width; ++u) {
                    const double area =
                        overlap(y * down, (y + 1) * down, v) * overlap(x * across, (x + 1) * across, u);
                    const glm::u8vec4& texel = whole.at(u, v);
                    for (int k = 0; k < 4; ++k) {
                        sum[k] += area * (k < 3 ? linear_from_srgb(texel[k] / 255.0) : texel[k] / 255.0);
                    }
                }
            }
            sum /= across * down;
            for (int k = 0; k < 4; ++k) {
                const double code = k < 3 ? srgb_from_linear(sum[k]) : sum[k];
                half.at(x, y)[k] = static_cast<std::uint8_t>(std::lround(255.0 * code));
            }
        }
    }
    return half;
}

TEST(RowShrinker, HalvesPicturesOfAnySizeByArea) {
    const std::vector<glm::ivec2> sizes{{64, 48}, {63, 47},  {1, 37}, {41, 1},
                                        {2, 3},   {57, 100}, {3, 3},  {1, 1}};
    for (const glm::ivec2& size : sizes) {
        const Image8 whole =
            random_picture(size.x, size.y, static_cast<std::uint32_t>(100 * size.x + size.y));
        Image8 expected = whole;
        for (int halvings = 0; halvings <= 4; ++halvings) {
            expected = halvings == 0 ? whole : half_by_areas(expected);
            RowShrinker shrinker(size, halvings);
            for (int y = 0; y < size.y; ++y) {
                shrinker.add(std::span(&whole.at(0, y), static_cast<std::size_t>(size.x)));
            }
            const Image8 shrunk = shrinker.take();
            ASSERT_EQ(glm::ivec2(shrunk.width, shrunk.height), halved_size(size, halvings));
            ASSERT_EQ(shrunk.width, expected.width);
            ASSERT_EQ(shrunk.height, expected.height);
            for (std::size_t k = 0; k < shrunk.texels.size(); ++k) {
                for (int c = 0; c < 4; ++c) {
                    EXPECT_LE(std::abs(shrunk.texels[k][c] - expected.texels[k][c]), 1)
                        << size.x << " x " << size.y << ", halved " << halvings << " times, texel " << k;
                }
            }
            expected = shrunk; // a difference of one code does not add up
        }
    }
}

TEST(RowShrinker, FillsMissingRowsWithBlackAndIgnoresExtraRows) {
    const Image8 whole(4, 4, {200, 200, 200, 255});
    RowShrinker half({4, 4}, 1);
    half.add(std::span(whole.texels).subspan(0, 4));
    half.add(std::span(whole.texels).subspan(0, 4));
    const Image8 cut = half.take();
    EXPECT_EQ(cut.at(1, 0), glm::u8vec4(200, 200, 200, 255));
    EXPECT_EQ(cut.at(1, 1), glm::u8vec4(0));
    for (const int halvings : {0, 2}) {
        RowShrinker more({4, 4}, halvings);
        for (int y = 0; y < 9; ++y) {
            more.add(std::span(whole.texels).subspan(0, 4));
        }
        EXPECT_EQ(more.take().texels.back(), glm::u8vec4(200, 200, 200, 255));
    }
}

} // namespace
} // namespace frustumscreen::image
