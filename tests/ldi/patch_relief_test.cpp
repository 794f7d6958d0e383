// Patches as block reliefs, drawn, against a ray cast that tries every triangle.
#include "app/ldi/patch_relief.h"
#include "tests/ldi/patch_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

namespace frustumscreen::ldi {
namespace {

constexpr int px = 96;
constexpr double texel_m = 2.0 * half_window_m / px;

PatchLimits town_limits() {
    return {.half_extent_m = glm::dvec2(half_window_m), .texel_m = texel_m};
}

/// The differences between a drawn window and the true one.
struct Compared {
    int hits = 0;
    int beyond_outline = 0; ///< hit in one alone, without an outline of the truth within a pixel
    int far = 0;            ///< more than three texels from every true hit within a pixel
    double mean_texels = 0.0;
    double code_rmse = 0.0; ///< of pixels amid one surface
    int amid = 0;
};

template <typename Visit> void for_each_around(int x, int y, const Visit& visit) {
    for (int j = std::max(0, y - 1); j <= std::min(px - 1, y + 1); ++j) {
        for (int i = std::max(0, x - 1); i <= std::min(px - 1, x + 1); ++i) {
            visit(i, j);
        }
    }
}

Compared compare(const SeenWindow& truth, const SeenWindow& seen) {
    Compared compared;
    double sum = 0.0;
    double squares = 0.0;
    for (int y = 0; y < px; ++y) {
        for (int x = 0; x < px; ++x) {
            if (truth.hit(x, y) != seen.hit(x, y)) {
                bool outline = false;
                for_each_around(x, y, [&](int i, int j) { outline |= truth.hit(i, j) == seen.hit(x, y); });
                compared.beyond_outline += outline ? 0 : 1;
                continue;
            }
            if (!truth.hit(x, y)) {
                continue;
            }
            ++compared.hits;
            double nearest = std::numeric_limits<double>::infinity();
            double spread = 0.0;
            int codes = 0;
            for_each_around(x, y, [&](int i, int j) {
                if (truth.hit(i, j)) {
                    for (int k = 0; k < 3; ++k) {
                        codes = std::max(
                            codes, std::abs(int{truth.colours.at(i, j)[k]} - int{truth.colours.at(x, y)[k]}));
                    }
                    nearest = std::min(
                        nearest, static_cast<double>(glm::distance(truth.point(i, j), seen.point(x, y))));
                    spread = std::max(
                        spread, static_cast<double>(glm::distance(truth.point(i, j), truth.point(x, y))));
                }
            });
            // Pixels lie about a texel apart, on slopes a few. A cell across an edge of two faces has colours of both.
            compared.far += nearest > 3.0 * texel_m ? 1 : 0;
            if (spread < 4.0 * texel_m && codes < 8) {
                ++compared.amid;
                sum += static_cast<double>(glm::distance(truth.point(x, y), seen.point(x, y)));
                for (int k = 0; k < 3; ++k) {
                    const double off = double(truth.colours.at(x, y)[k]) - double(seen.colours.at(x, y)[k]);
                    squares += off * off / 3.0;
                }
            }
        }
    }
    compared.mean_texels = sum / texel_m / std::max(1, compared.amid);
    compared.code_rmse = std::sqrt(squares / std::max(1, compared.amid));
    return compared;
}

TEST(PatchRelief, MatchesARayCastFromEyesInItsPatch) {
    const Hemisphere hemisphere(eye_distance_m);
    std::mt19937 random(49);
    for (const unsigned seed : {1U, 2U}) {
        const TriangleWorld world = town(seed);
        for (const std::size_t patch : {std::size_t{0}, std::size_t{1}, std::size_t{4}, std::size_t{6}}) {
            const PatchRelief relief = make_patch_relief(world, hemisphere, patch, town_limits());
            EXPECT_NEAR(relief.texel_m, texel_m, 1e-9);
            for (int k = 0; k < 3; ++k) {
                const glm::dvec3 eye = seeded_eye(hemisphere, patch, random);
                ASSERT_EQ(hemisphere.patch_of(eye), patch);
                const Compared compared = compare(ray_cast(world, eye, px), drawn(relief, eye, px));
                SCOPED_TRACE(testing::Message() << "town " << seed << ", patch " << patch << ", eye " << k);
                EXPECT_GT(compared.hits, px * px / 2);
                EXPECT_GT(compared.amid, compared.hits / 2);
                EXPECT_EQ(compared.beyond_outline, 0);
                EXPECT_LT(compared.mean_texels, 0.5);
                EXPECT_LT(compared.code_rmse, 2.0);
                EXPECT_LT(compared.far, compared.hits / 200);
            }
        }
    }
}

TEST(PatchRelief, ContainsSurfacesHiddenFromTheFirstCamera) {
    // A plate before a wall: the camera on the axis does not see the wall's middle, one of the others sees a part of it.
    TriangleWorld world;
    const auto plate = [&world](float half, float z, const glm::u8vec4& colour) {
        const auto first = static_cast<std::uint32_t>(world.positions.size());
        for (const glm::vec2& side :
             {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(-1, 1), glm::vec2(1, 1)}) {
            world.positions.emplace_back(half * side, z);
            world.colours.push_back(colour);
        }
        for (const std::uint32_t k : {0U, 1U, 2U, 2U, 1U, 3U}) {
            world.indices.push_back(first + k);
        }
    };
    plate(0.5F, -0.2F, {200, 40, 40, 255});
    plate(0.03F, -0.05F, {40, 200, 40, 255});
    const Hemisphere hemisphere(eye_distance_m);
    const PatchRelief relief = make_patch_relief(world, hemisphere, 0, town_limits());
    int hidden_from_first = 0;
    const glm::dvec3 first = hemisphere.cameras()[0];
    for (const std::size_t camera : hemisphere.own_cameras_of(0)) {
        const glm::dvec3& eye = hemisphere.cameras()[camera];
        const SeenWindow truth = ray_cast(world, eye, px);
        const SeenWindow seen = drawn(relief, eye, px);
        for (int y = 0; y < px; ++y) {
            for (int x = 0; x < px; ++x) {
                ASSERT_TRUE(truth.hit(x, y) && seen.hit(x, y));
                const glm::vec3& point = truth.point(x, y);
                bool outline = false;
                for_each_around(x, y, [&](int i, int j) { outline |= truth.point(i, j).z > -0.19F; });
                // Where the ray from the first camera meets the plate's plane.
                const glm::dvec3 on_plate =
                    first + (first.z + 0.05) / (first.z - double(point.z)) * (glm::dvec3(point) - first);
                if (!outline && std::max(std::abs(on_plate.x), std::abs(on_plate.y)) < 0.028) {
                    ++hidden_from_first;
                    EXPECT_LT(glm::distance(seen.point(x, y), point), texel_m) << x << ", " << y;
                    EXPECT_NEAR(int{seen.colours.at(x, y).r}, 200, 2);
                }
            }
        }
    }
    EXPECT_GT(hidden_from_first, 50);
}

TEST(PatchRelief, HasNoHolesBesideThinObjects) {
    const Hemisphere hemisphere(eye_distance_m);
    const TriangleWorld world = wires_before_a_wall();
    std::mt19937 random(7);
    for (const std::size_t patch : {std::size_t{0}, std::size_t{3}}) {
        const PatchRelief relief = make_patch_relief(world, hemisphere, patch, town_limits());
        for (int k = 0; k < 4; ++k) {
            const SeenWindow seen = drawn(relief, seeded_eye(hemisphere, patch, random), px);
            for (const glm::vec3& point : seen.points) {
                ASSERT_FALSE(std::isnan(point.x)); // the wires may be missed, the wall behind them not
            }
        }
    }
}

/// Root mean square of the difference in codes, all pixels and channels.
double rmse(const SeenWindow& a, const SeenWindow& b) {
    double squares = 0.0;
    for (std::size_t k = 0; k < a.colours.texels.size(); ++k) {
        for (int channel = 0; channel < 3; ++channel) {
            const double off = double(a.colours.texels[k][channel]) - double(b.colours.texels[k][channel]);
            squares += off * off;
        }
    }
    return std::sqrt(squares / (3.0 * static_cast<double>(a.colours.texels.size())));
}

TEST(PatchRelief, ChangesLittleAcrossPatchBorders) {
    constexpr int fine = 256;
    const PatchLimits fine_limits{.half_extent_m = glm::dvec2(half_window_m),
                                  .texel_m = 2.0 * half_window_m / fine};
    const Hemisphere hemisphere(eye_distance_m);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> u(0.0, 1.0);
    for (const TriangleWorld& world : {hills(), town(3)}) {
        std::vector<PatchRelief> patches;
        for (const std::size_t patch : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
            patches.push_back(make_patch_relief(world, hemisphere, patch, fine_limits));
        }
        const PatchDirections& ring = hemisphere.directions_of(1);
        const auto eye_at = [](double polar, double azimuth) {
            return eye_distance_m * glm::dvec3(std::sin(polar) * std::cos(azimuth),
                                               std::sin(polar) * std::sin(azimuth), std::cos(polar));
        };
        for (int k = 0; k < 4; ++k) {
            const glm::dvec3 from_centre = eye_at(
                ring.min_polar_rad, ring.middle_azimuth_rad + ring.half_width_rad * (2.0 * u(random) - 1.0));
            EXPECT_LE(rmse(drawn(patches[0], from_centre, fine, 4), drawn(patches[1], from_centre, fine, 4)),
                      2.0)
                << "centre to ring, place " << k;
            const glm::dvec3 along_ring = eye_at(std::lerp(ring.min_polar_rad, ring.max_polar_rad, u(random)),
                                                 ring.middle_azimuth_rad + ring.half_width_rad);
            EXPECT_LE(rmse(drawn(patches[1], along_ring, fine, 4), drawn(patches[2], along_ring, fine, 4)),
                      2.0)
                << "along the ring, place " << k;
        }
    }
}

TEST(PatchRelief, KeepsHolesAndColoursOfACutOutTexture) {
    // A wall whose left half is a hole, 2 m wide: its texels are of 0.5 m, so the hole ends at x = 0 to a texel's middle.
    auto texture = std::make_shared<image::Image8>(4, 1);
    texture->texels = {{0, 0, 0, 0}, {90, 160, 230, 0}, {90, 160, 230, 255}, {90, 160, 230, 255}};
    TriangleWorld world;
    for (const glm::vec2& side : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(-1, 1), glm::vec2(1, 1)}) {
        world.positions.emplace_back(side, -0.05F);
        world.texture_places.emplace_back(0.5F + 0.5F * side.x, 0.5F);
    }
    world.indices = {0, 1, 2, 2, 1, 3};
    world.texture = texture;
    world.cut_out = true;
    const Hemisphere hemisphere(eye_distance_m);
    const PatchRelief relief = make_patch_relief(world, hemisphere, 0, town_limits());
    const glm::dvec3 eye(0.03, -0.05, 0.49);
    const SeenWindow seen = drawn(relief, eye, px);
    int hits = 0;
    for (int y = 0; y < px; ++y) {
        for (int x = 0; x < px; ++x) {
            // Alpha is one half where the texture has its middle.
            const double on_window = half_window_m * (2.0 * (x + 0.5) / px - 1.0);
            const double on_wall = eye.x + (on_window - eye.x) * (eye.z + 0.05) / eye.z;
            if (std::abs(on_wall) > texel_m) {
                ASSERT_EQ(seen.hit(x, y), on_wall > 0.0) << x << ", " << y;
            }
            if (seen.hit(x, y)) {
                ++hits;
                EXPECT_EQ(seen.colours.at(x, y), glm::u8vec4(90, 160, 230, 255));
            }
        }
    }
    EXPECT_GT(hits, px * px / 4);
}

TEST(PatchRelief, IsEmptyWithoutVisibleTriangles) {
    const Hemisphere hemisphere(eye_distance_m);
    TriangleWorld beside = town(1);
    for (glm::vec3& position : beside.positions) {
        position.x += 5.0F;
    }
    TriangleWorld broken;
    broken.positions = {{0, 0, std::numeric_limits<float>::quiet_NaN()}, {1, 0, -1}, {0, 1, -1}, {1, 1, -1}};
    broken.colours.assign(4, glm::u8vec4(255));
    broken.indices = {0, 1, 2, 1, 2, 9, 3, 3, 3};
    for (const TriangleWorld& world : {TriangleWorld{}, beside, broken}) {
        const PatchRelief relief = make_patch_relief(world, hemisphere, 0, town_limits());
        EXPECT_TRUE(relief.empty());
        const SeenWindow seen = drawn(relief, hemisphere.cameras()[0], px);
        EXPECT_TRUE(std::none_of(seen.colours.texels.begin(), seen.colours.texels.end(),
                                 [](const glm::u8vec4& texel) { return texel.a != 0; }));
    }
}

/// A roof that is thinner than a texel, light above and dark below: a patch cannot tell both sides apart.
TEST(PatchRelief, OneSidedWorldShowsNoUndersideOfAThinRoof) {
    const Hemisphere hemisphere(eye_distance_m);
    const PatchLimits limits{.half_extent_m = glm::dvec2(half_window_m), .texel_m = 2.0 * half_window_m / 64};
    TriangleWorld roof;
    const auto height = [](float x, float y) {
        return -0.05F + 0.4F * x + 0.02F * std::sin(60.0F * x) * std::cos(50.0F * y);
    };
    constexpr int cells = 40;
    for (const bool below : {false, true}) {
        const auto first = static_cast<std::uint32_t>(roof.positions.size());
        for (int j = 0; j <= cells; ++j) {
            for (int i = 0; i <= cells; ++i) {
                const float x = 0.005F * static_cast<float>(i - cells / 2);
                const float y = 0.005F * static_cast<float>(j - cells / 2);
                roof.positions.emplace_back(x, y, height(x, y) - (below ? 0.0002F : 0.0F));
                roof.colours.emplace_back(glm::u8vec3(static_cast<std::uint8_t>(below ? 20 : 200)), 255);
            }
        }
        for (std::uint32_t j = 0; j < cells; ++j) {
            for (std::uint32_t i = 0; i < cells; ++i) {
                const std::uint32_t a = first + j * (cells + 1) + i;
                const std::uint32_t b = a + 1;
                const std::uint32_t c = a + cells + 1;
                const std::uint32_t d = c + 1;
                for (const auto& [p, q, r] : {std::array{a, b, d}, std::array{a, d, c}}) {
                    const std::array corners = below ? std::array{p, r, q} : std::array{p, q, r};
                    roof.indices.insert(roof.indices.end(), corners.begin(), corners.end());
                }
            }
        }
    }
    std::array<std::size_t, 2> dark{};
    std::size_t light = 0;
    for (const bool one_sided : {false, true}) {
        roof.one_sided = one_sided;
        const PatchRelief patch = make_patch_relief(roof, hemisphere, 0, limits);
        std::mt19937 random(4);
        for (int k = 0; k < 6; ++k) {
            const SeenWindow seen = drawn(patch, seeded_eye(hemisphere, 0, random), 96);
            for (const glm::u8vec4& colour : seen.colours.texels) {
                dark.at(one_sided) += colour.a != 0 && colour.r < 150 ? 1U : 0U;
                light += colour.r >= 150 ? 1U : 0U;
            }
        }
    }
    EXPECT_GT(light, 50'000U);
    EXPECT_GT(dark[0], 100U) << "the roof is thick enough for both sides: this proves nothing";
    EXPECT_EQ(dark[1], 0U);
}

} // namespace
} // namespace frustumscreen::ldi
