#include "app/bench/techniques/relief/cone_map.h"
#include "app/bench/techniques/relief/max_mipmap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace frustumscreen::bench {
namespace {

constexpr int side = 32;
constexpr double codes = 65535.0;

/// Hills of several sizes that cover every height.
image::Image16 hills(std::uint64_t seed) {
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> random(0.0, 2.0 * std::numbers::pi);
    std::array<double, 8> phase{};
    for (double& p : phase) {
        p = random(engine);
    }
    image::Image16 depth(side, side);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            double height = 0.0;
            for (std::size_t k = 0; k < 4; ++k) {
                const double wave = 2.0 * std::numbers::pi * static_cast<double>(k + 1) / side;
                height += 0.12 * std::sin(wave * x + phase[k]) * std::sin(wave * y + phase[k + 4]);
            }
            depth.at(x, y) = static_cast<std::uint16_t>(codes * (0.5 + height));
        }
    }
    return depth;
}

/// The widest cone, at most 1, that contains no texel of `narrows`; tests all pairs.
template <typename Narrows> double widest(const image::Image16& depth, int x, int y, const Narrows& narrows) {
    double ratio = 1.0;
    for (int v = 0; v < side; ++v) {
        for (int u = 0; u < side; ++u) {
            const double height = (depth.at(x, y) - depth.at(u, v)) / codes;
            if (height > 0.0 && narrows(u, v)) {
                ratio = std::fmin(ratio, std::hypot(u - x, v - y) / side / height);
            }
        }
    }
    return ratio;
}

TEST(ConeMap, EmptyConeIsTheWidestWithoutSurfaceInside) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const image::Image16 depth = hills(seed);
        const image::Image16 cones = empty_cones(depth);
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const double expected = widest(depth, x, y, [](int, int) { return true; });
                EXPECT_NEAR(cones.at(x, y) / codes, expected, 2e-5) << x << ' ' << y;
            }
        }
    }
}

TEST(ConeMap, ARelaxedConeIsNarrowedOnlyWhereTheSurfaceFallsBehind) {
    const image::Image16 depth = hills(10);
    const image::Image16 cones = relaxed_cones(depth);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const auto falls = [&](int u, int v) {
                const double longer = std::fmax(std::abs(u - x), std::abs(v - y));
                const int next_u = u + static_cast<int>(std::round((u - x) / longer));
                const int next_v = v + static_cast<int>(std::round((v - y) / longer));
                return next_u < 0 || next_v < 0 || next_u >= side || next_v >= side ||
                       depth.at(next_u, next_v) > depth.at(u, v);
            };
            EXPECT_NEAR(cones.at(x, y) / codes, widest(depth, x, y, falls), 2e-5) << x << ' ' << y;
        }
    }
}

TEST(ConeMap, ARelaxedConeIsAtLeastAsWideAsTheEmptyOne) {
    const image::Image16 depth = hills(4);
    const image::Image16 empty = empty_cones(depth);
    const image::Image16 relaxed = relaxed_cones(depth);
    double sum_empty = 0.0;
    double sum_relaxed = 0.0;
    for (std::size_t k = 0; k < empty.texels.size(); ++k) {
        EXPECT_GE(relaxed.texels[k], empty.texels[k]);
        sum_empty += empty.texels[k];
        sum_relaxed += relaxed.texels[k];
    }
    EXPECT_GT(sum_relaxed, 1.1 * sum_empty);
}

/// Surface interpolated between the texels' middles.
double bilinear(const image::Image16& depth, double x, double y) {
    const int left = std::clamp(static_cast<int>(std::floor(x)), 0, side - 2);
    const int top = std::clamp(static_cast<int>(std::floor(y)), 0, side - 2);
    const double u = x - left;
    const double v = y - top;
    return ((1 - v) * ((1 - u) * depth.at(left, top) + u * depth.at(left + 1, top)) +
            v * ((1 - u) * depth.at(left, top + 1) + u * depth.at(left + 1, top + 1))) /
           codes;
}

TEST(ConeMap, ARayCrossesTheSurfaceOnceAtMostInsideARelaxedCone) {
    std::mt19937_64 engine(5);
    std::uniform_real_distribution<double> random(0.0, 1.0);
    int entered = 0;
    for (std::uint64_t seed = 5; seed <= 8; ++seed) {
        const image::Image16 depth = hills(seed);
        const image::Image16 cones = relaxed_cones(depth);
        for (int ray = 0; ray < 5000; ++ray) {
            const int x = static_cast<int>(random(engine) * side);
            const int y = static_cast<int>(random(engine) * side);
            const double apex = depth.at(x, y) / codes;
            const double start = apex * random(engine);
            const double turn = 2.0 * std::numbers::pi * random(engine);
            const double fall = std::tan(0.5 * std::numbers::pi * random(engine)); // depth / distance
            const double ratio = cones.at(x, y) / codes;
            const double reach = ratio * (apex - start) / (1.0 + ratio * fall); // distance at which the ray
                                                                                // leaves the cone
            bool was_inside = false;
            double deepest = 0.0;
            for (int k = 0; k <= 400; ++k) {
                const double distance = reach * k / 400.0;
                const double u = x + side * distance * std::cos(turn);
                const double v = y + side * distance * std::sin(turn);
                if (u < 0.0 || v < 0.0 || u > side - 1 || v > side - 1) {
                    break;
                }
                const double inside = start + fall * distance - bilinear(depth, u, v);
                deepest = std::fmax(deepest, inside);
                was_inside = was_inside || inside > 0.0;
                // A ray that re-emerges may only have cut a corner smaller than the texels resolve.
                if (was_inside && inside < 0.0) {
                    EXPECT_LT(deepest, 0.02) << seed << " at " << x << ' ' << y;
                    break;
                }
            }
            entered += was_inside ? 1 : 0;
        }
    }
    EXPECT_GT(entered, 500);
}

TEST(MaxMipmap, EachTexelIsTheTightBoundOfAllTexelsBelowIt) {
    std::mt19937_64 engine(9);
    image::Image<glm::u16vec2> material(side, side);
    for (glm::u16vec2& texel : material.texels) {
        texel = engine() % 3 == 0 ? glm::u16vec2(65535, 0) : glm::u16vec2(engine() % 30000, 40000);
        texel.y = static_cast<std::uint16_t>(texel.y == 0 ? 0 : texel.y + engine() % 20000);
    }
    const MaxMipmap levels = max_mipmap(material);
    ASSERT_EQ(levels.size(), 6U);
    for (std::size_t level = 0; level < levels.size(); ++level) {
        ASSERT_EQ(levels[level].width, side >> level);
        for (int y = 0; y < levels[level].height; ++y) {
            for (int x = 0; x < levels[level].width; ++x) {
                glm::u16vec2 bound(65535, 0);
                for (int v = y << level; v < (y + 1) << level; ++v) {
                    for (int u = x << level; u < (x + 1) << level; ++u) {
                        bound = {std::min(bound.x, material.at(u, v).x),
                                 std::max(bound.y, material.at(u, v).y)};
                    }
                }
                EXPECT_EQ(levels[level].at(x, y), bound);
            }
        }
    }
}

} // namespace
} // namespace frustumscreen::bench
