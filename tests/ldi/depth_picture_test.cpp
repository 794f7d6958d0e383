// Depth pictures against a ray cast that tries every triangle.
#include "app/ldi/depth_picture.h"
#include "app/ldi/triangle_rasterizer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <utility>
#include <vector>

namespace frustumscreen::ldi {
namespace {

TEST(DepthPicture, ProjectsAPointOntoItsRay) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    for (int k = 0; k < 1000; ++k) {
        const PictureCamera camera =
            camera_through_window({u(random), u(random), 0.6 + 0.5 * u(random)}, {0.2, 0.15}, 64, 48);
        const PictureMap map(camera);
        const double x = 32.0 + 60.0 * u(random);
        const double y = 24.0 + 60.0 * u(random);
        const glm::dvec3 on_window(0.2 * (2.0 * x / 64.0 - 1.0), 0.15 * (1.0 - 2.0 * y / 48.0), 0.0);
        const double share = 2.0 + u(random); // of the way to the window
        const glm::dvec3 point = camera.eye + share * (on_window - camera.eye);
        const auto place = map.project(point);
        ASSERT_TRUE(place);
        EXPECT_NEAR(place->x, x, 1e-10);
        EXPECT_NEAR(place->y, y, 1e-10);
        EXPECT_NEAR(place->nearness, 1.0 / share, 1e-12);
        EXPECT_NEAR(glm::length(map.point(x, y, place->nearness) - point), 0.0, 1e-12);
        EXPECT_FALSE(map.project(camera.eye - 0.3 * (on_window - camera.eye)));
    }
}

/// A few hundred random triangles behind and before a window.
TriangleWorld soup(unsigned seed, int triangles) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> u(-1.0F, 1.0F);
    TriangleWorld world;
    for (int k = 0; k < triangles; ++k) {
        const glm::vec3 middle(0.3F * u(random), 0.3F * u(random), -0.25F + 0.35F * u(random));
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            world.indices.push_back(static_cast<std::uint32_t>(world.positions.size()));
            world.positions.push_back(middle + 0.08F * glm::vec3(u(random), u(random), u(random)));
            world.colours.emplace_back(
                glm::vec3(127.0F) + 127.0F * glm::vec3(u(random), u(random), u(random)), 255);
        }
    }
    return world;
}

struct Hit {
    double way = std::numeric_limits<double>::infinity(); ///< in rays
    double margin = 0.0; ///< least share of a corner: how far from the triangle's border
    glm::dvec3 colour{0.0};
    double slack = 0.0; ///< of 1 / way, because the corners are rounded to a share of a pixel
};

/// Möller and Trumbore for one triangle.
bool meets(const TriangleWorld& world, std::size_t triangle, const glm::dvec3& eye, const glm::dvec3& ray,
           Hit& hit) {
    const glm::dvec3 a(world.positions[3 * triangle]);
    const glm::dvec3 ab = glm::dvec3(world.positions[3 * triangle + 1]) - a;
    const glm::dvec3 ac = glm::dvec3(world.positions[3 * triangle + 2]) - a;
    const glm::dvec3 p = glm::cross(ray, ac);
    const double determinant = glm::dot(ab, p);
    const double u = glm::dot(eye - a, p) / determinant;
    const glm::dvec3 q = glm::cross(eye - a, ab);
    const double v = glm::dot(ray, q) / determinant;
    const double way = glm::dot(ac, q) / determinant;
    hit = {way, std::min({u, v, 1.0 - u - v}),
           (1.0 - u - v) * glm::dvec3(world.colours[3 * triangle]) +
               u * glm::dvec3(world.colours[3 * triangle + 1]) +
               v * glm::dvec3(world.colours[3 * triangle + 2]),
           0.0};
    return way > 0.0 && hit.margin > 0.0;
}

/// The nearest triangle of a ray. `doubtful`: within a thousandth of a pixel, as the corners are rounded, it might be another.
Hit cast(const TriangleWorld& world, const PictureMap& map, double x, double y, bool& doubtful) {
    Hit nearest;
    doubtful = false;
    std::vector<std::array<Hit, 5>> around;
    for (std::size_t triangle = 0; triangle < world.triangle_count(); ++triangle) {
        constexpr double shift_px = 2.0 / 1024.0;
        std::array<Hit, 5> hits;
        std::array<bool, 5> met{};
        for (std::size_t k = 0; k < 5; ++k) {
            const double right = k == 1 ? shift_px : k == 2 ? -shift_px : 0.0;
            const double down = k == 3 ? shift_px : k == 4 ? -shift_px : 0.0;
            met[k] = meets(world, triangle, map.eye(), map.ray(x + right, y + down), hits[k]);
        }
        if (met[0] && hits[0].way < nearest.way) {
            nearest = hits[0];
            nearest.slack = std::fabs(1.0 / hits[1].way - 1.0 / hits[0].way) +
                            std::fabs(1.0 / hits[3].way - 1.0 / hits[0].way);
        }
        if (met[0] || met[1] || met[2] || met[3] || met[4]) {
            around.push_back(hits);
            doubtful = doubtful || !(met[0] && met[1] && met[2] && met[3] && met[4]);
        }
    }
    for (const std::array<Hit, 5>& hits : around) { // one surface passes through another
        if (hits[0].way != nearest.way && std::fabs(1.0 / hits[0].way - 1.0 / nearest.way) < 1e-3) {
            doubtful = true;
        }
    }
    return nearest;
}

TEST(DepthPicture, MatchesARayCastInHitDepthAndColour) {
    TriangleRasterizer rasterizer;
    DepthPicture picture;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    std::size_t hits = 0;
    std::size_t empty = 0;
    std::size_t doubts = 0;
    for (unsigned pose = 0; pose < 12; ++pose) {
        const TriangleWorld world = soup(100 + pose, 300);
        picture.begin(camera_through_window({0.5 * u(random), 0.5 * u(random), 0.5 + 0.2 * u(random)},
                                            {0.2, 0.15}, 64, 48));
        rasterizer.draw(world, picture);
        const PictureMap map(picture.camera);
        for (int y = 0; y < 48; ++y) {
            for (int x = 0; x < 64; ++x) {
                bool doubtful = false;
                const Hit hit = cast(world, map, x + 0.5, y + 0.5, doubtful);
                const float nearness = picture.nearness[picture.at(x, y)];
                const glm::u8vec4 colour = picture.colours[picture.at(x, y)];
                if (doubtful) {
                    ++doubts;
                    continue;
                }
                ASSERT_EQ(nearness > 0.0F, std::isfinite(hit.way)) << pose << ": " << x << ", " << y;
                ASSERT_EQ(colour.a, nearness > 0.0F ? 255 : 0);
                if (nearness > 0.0F) {
                    ++hits;
                    EXPECT_NEAR(nearness, 1.0 / hit.way, hit.slack + 1e-6) << x << ", " << y;
                    EXPECT_NEAR(glm::length(glm::dvec3(colour) - hit.colour), 0.0, 0.9)
                        << x << ", " << y; // sqrt(3) / 2
                } else {
                    ++empty;
                }
            }
        }
    }
    EXPECT_GT(hits, 15'000U);
    EXPECT_GT(empty, 500U);
    EXPECT_LT(doubts, 8'000U);
}

TEST(DepthPicture, AdjacentTrianglesCoverEachPixelOnce) {
    // Rows of pixels' middles lie on edges; the larger sheets' triangles are cut.
    TriangleRasterizer rasterizer;
    std::mt19937 random(9);
    std::uniform_real_distribution<float> u(-0.3F, 0.3F);
    std::size_t pictures = 0;
    for (const float half_m : {0.4F, 5.0F, 1e4F}) {
        for (const float jitter : {0.0F, 1.0F}) {
            constexpr std::uint32_t cells = 16;
            TriangleWorld sheet;
            for (std::uint32_t k = 0; k < (cells + 1) * (cells + 1); ++k) {
                const glm::vec2 cell(k % (cells + 1), k / (cells + 1));
                const bool border = k % (cells + 1) % cells == 0 || k / (cells + 1) % cells == 0;
                const glm::vec2 moved = border ? cell : cell + jitter * glm::vec2(u(random), u(random));
                sheet.positions.emplace_back(half_m * (moved * (2.0F / cells) - 1.0F), -0.02F);
            }
            for (std::uint32_t k = 0; k < cells * (cells + 1); ++k) {
                if (k % (cells + 1) < cells) {
                    const std::uint32_t below = k + cells + 1;
                    sheet.indices.insert(sheet.indices.end(), {k, k + 1, below + 1, k, below + 1, below});
                }
            }
            for (const glm::dvec3& eye :
                 {glm::dvec3(0.0, 0.0, 0.5), glm::dvec3(0.1, -0.2, 0.3), glm::dvec3(0.0, 0.0, 0.01)}) {
                DepthPicture all;
                all.begin(camera_through_window(eye, {0.1, 0.1}, 64, 64));
                rasterizer.draw(sheet, all);
                std::vector<int> times(all.nearness.size(), 0);
                for (std::size_t triangle = 0; triangle < sheet.triangle_count(); ++triangle) {
                    TriangleWorld one;
                    one.positions = sheet.positions;
                    one.indices.assign(&sheet.indices[3 * triangle], &sheet.indices[3 * triangle] + 3);
                    DepthPicture picture;
                    picture.begin(all.camera);
                    rasterizer.draw(one, picture);
                    for (std::size_t pixel = 0; pixel < times.size(); ++pixel) {
                        times[pixel] += picture.nearness[pixel] > 0.0F ? 1 : 0;
                    }
                }
                EXPECT_EQ(std::count(times.begin(), times.end(), 1), 64 * 64)
                    << half_m << ", " << jitter << ", " << eye.x;
                EXPECT_EQ(std::count(all.nearness.begin(), all.nearness.end(), 0.0F), 0);
                ++pictures;
            }
        }
    }
    EXPECT_EQ(pictures, 18U);
}

TEST(DepthPicture, ClipsATriangleThroughTheEyePlaneAsARayCastDoes) {
    TriangleRasterizer rasterizer;
    DepthPicture picture;
    std::mt19937 random(11);
    std::uniform_real_distribution<float> u(-1.0F, 1.0F);
    std::size_t hits = 0;
    for (int k = 0; k < 40; ++k) {
        TriangleWorld world; // corners on both sides of the eye's plane, one far away
        for (const float z : {3.0F, -2.0F, -50.0F}) {
            world.indices.push_back(static_cast<std::uint32_t>(world.positions.size()));
            world.positions.emplace_back(2.0F * u(random), 2.0F * u(random), z);
            world.colours.emplace_back(
                glm::vec3(127.0F) + 127.0F * glm::vec3(u(random), u(random), u(random)), 255);
        }
        picture.begin(camera_through_window({0.05, 0.02, 0.5}, {0.2, 0.2}, 48, 48));
        rasterizer.draw(world, picture);
        const PictureMap map(picture.camera);
        for (int y = 0; y < 48; ++y) {
            for (int x = 0; x < 48; ++x) {
                bool doubtful = false;
                const Hit hit = cast(world, map, x + 0.5, y + 0.5, doubtful);
                const float nearness = picture.nearness[picture.at(x, y)];
                if (!doubtful) {
                    ASSERT_EQ(nearness > 0.0F, std::isfinite(hit.way)) << k << ": " << x << ", " << y;
                    hits += nearness > 0.0F ? 1 : 0;
                }
            }
        }
    }
    EXPECT_GT(hits, 500U);
}

TEST(DepthPicture, CutOutHolesAreNotDrawn) {
    TriangleWorld world; // a square of two halves, of which the upper texel is a hole
    world.positions = {{-0.1F, -0.1F, 0.0F}, {0.1F, -0.1F, 0.0F}, {0.1F, 0.1F, 0.0F}, {-0.1F, 0.1F, 0.0F}};
    world.texture_places = {{0.0F, 0.75F}, {1.0F, 0.75F}, {1.0F, 0.25F}, {0.0F, 0.25F}};
    world.indices = {0, 1, 2, 0, 2, 3};
    image::Image8 texture(1, 2, {10, 20, 30, 255});
    texture.at(0, 0).a = 0;
    world.texture = std::make_shared<const image::Image8>(texture);
    for (const bool cut_out : {false, true}) {
        world.cut_out = cut_out;
        DepthPicture picture;
        picture.begin(camera_through_window({0.0, 0.0, 0.4}, {0.1, 0.1}, 16, 16));
        TriangleRasterizer().draw(world, picture);
        for (int y = 0; y < 16; ++y) { // coverage is one half in the middle
            EXPECT_EQ(picture.colours[picture.at(5, y)],
                      cut_out && y < 8 ? glm::u8vec4(0) : glm::u8vec4(10, 20, 30, 255));
        }
    }
}

TEST(DepthPicture, SkipsInvalidIndicesAndNonFiniteCorners) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    TriangleWorld world;
    world.positions = {{-0.1F, -0.1F, 0.0F}, {0.1F, -0.1F, 0.0F}, {0.1F, nan, 0.0F}, {infinity, 0.1F, 0.0F}};
    world.indices = {0, 1, 2, 0, 1, 3, 0, 1, 4, 0xFFFFFFFFU, 1, 0, 0, 1};
    DepthPicture picture;
    picture.begin(camera_through_window({0.0, 0.0, 0.4}, {0.1, 0.1}, 16, 16));
    TriangleRasterizer().draw(world, picture);
    EXPECT_EQ(std::count(picture.nearness.begin(), picture.nearness.end(), 0.0F), 16 * 16);
}

TEST(TriangleRasterizer, DrawsOnlyFrontFacesOfAOneSidedWorld) {
    for (unsigned seed = 0; seed < 4; ++seed) {
        TriangleWorld world = soup(seed, 300);
        const glm::dvec3 eye(0.1 * seed, -0.1, 0.5);
        TriangleWorld facing = world;
        facing.indices.clear();
        for (std::size_t k = 0; k < world.indices.size(); k += 3) {
            const auto corner = [&](std::size_t of) {
                return glm::dvec3(world.positions[world.indices[k + of]]);
            };
            const glm::dvec3 normal = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
            if (glm::dot(normal, eye - corner(0)) > 0.0) {
                facing.indices.insert(facing.indices.end(),
                                      world.indices.begin() + static_cast<std::ptrdiff_t>(k),
                                      world.indices.begin() + static_cast<std::ptrdiff_t>(k + 3));
            }
        }
        EXPECT_GT(facing.triangle_count(), 50U);
        EXPECT_LT(facing.triangle_count(), 250U);
        world.one_sided = true;
        DepthPicture one_sided, expected;
        for (auto [picture, of] : {std::pair(&one_sided, &world), std::pair(&expected, &facing)}) {
            picture->begin(camera_through_window(eye, {0.2, 0.2}, 96, 96));
            TriangleRasterizer().draw(*of, *picture);
        }
        EXPECT_EQ(one_sided.nearness, expected.nearness);
        EXPECT_EQ(one_sided.colours, expected.colours);
    }
}

} // namespace
} // namespace frustumscreen::ldi
