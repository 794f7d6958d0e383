// Layered depth images: merged points against geometry, McMillan's order against a depth test, pictures against the rasterizer's.
#include "app/ldi/layered_depth.h"
#include "app/ldi/patch_layers.h"
#include "app/ldi/peers.h"
#include "app/ldi/triangle_rasterizer.h"
#include "tests/ldi/worlds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace frustumscreen::ldi {
namespace {

constexpr double radius_m = 0.5;
const CameraView view{
    .half_extent_m = {0.1, 0.1}, .width = 128, .height = 128, .margin = 1.8, .max_side = 1024};

struct Seen {
    Hemisphere hemisphere{radius_m};
    std::array<DepthPicture, camera_count> pictures;

    explicit Seen(const TriangleWorld& world) {
        TriangleRasterizer rasterizer;
        for (std::size_t camera = 0; camera < camera_count; ++camera) {
            pictures[camera].begin(camera_at(view, hemisphere.cameras()[camera]));
            rasterizer.draw(world, pictures[camera]);
        }
    }
    [[nodiscard]] LayeredDepth patch(std::size_t number) const {
        return patch_layers(hemisphere, number, pictures, view);
    }
};

const Seen& seen_spheres() {
    static const Seen seen(spheres_before_a_wall());
    return seen;
}

DepthPicture empty_picture(const glm::dvec3& eye) {
    DepthPicture picture;
    picture.begin(camera_through_window(eye, view.half_extent_m, view.width, view.height));
    return picture;
}

DepthPicture drawn(const TriangleWorld& world, const glm::dvec3& eye) {
    DepthPicture picture = empty_picture(eye);
    TriangleRasterizer().draw(world, picture);
    return picture;
}

/// An eye of the patch, at 0.7 to 1.3 of the cameras' distance.
glm::dvec3 eye_in(const Hemisphere& hemisphere, std::size_t patch, std::mt19937& random) {
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    for (;;) {
        const glm::dvec3 eye =
            hemisphere.middle_of(patch) + 0.6 * glm::dvec3(u(random), u(random), u(random));
        if (hemisphere.patch_of(eye) == patch) {
            return radius_m * (1.0 + 0.3 * u(random)) * glm::normalize(eye);
        }
    }
}

struct Difference {
    std::size_t holes = 0;     ///< empty, where `truth` is not
    std::size_t unmatched = 0; ///< surfaces that `truth` does not show within some pixels
    std::size_t compared = 0;
};

Difference compare(const DepthPicture& picture, const DepthPicture& truth, int within_px) {
    Difference difference;
    for (int y = 0; y < truth.camera.height; ++y) {
        for (int x = 0; x < truth.camera.width; ++x) {
            const glm::u8vec4 colour = picture.colours[picture.at(x, y)];
            bool near = false;
            for (int v = std::max(0, y - within_px); v <= std::min(y + within_px, truth.camera.height - 1);
                 ++v) {
                for (int u = std::max(0, x - within_px); u <= std::min(x + within_px, truth.camera.width - 1);
                     ++u) {
                    near = near || truth.colours[truth.at(u, v)] == colour;
                }
            }
            difference.unmatched += near || colour.a == 0 ? 0 : 1;
            difference.holes += colour.a == 0 && truth.colours[truth.at(x, y)].a != 0 ? 1 : 0;
            ++difference.compared;
        }
    }
    return difference;
}

/// Depth of walls behind and before the window, metres; none hides all of another.
constexpr std::array wall_z{-0.12F, -0.08F, -0.04F, 0.01F};

TriangleWorld walls() {
    TriangleWorld world;
    for (std::size_t k = 0; k < wall_z.size(); ++k) {
        const auto step = static_cast<float>(k);
        add_rectangle(world, {-0.05F + 0.04F * step, 0.03F - 0.03F * step, wall_z[k]},
                      {0.07F - 0.01F * step, 0.05F}, {static_cast<std::uint8_t>(50 + 50 * k), 10, 200});
    }
    return world;
}

std::size_t wall_of(double z) {
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < wall_z.size(); ++k) {
        if (std::fabs(z - static_cast<double>(wall_z[k])) <
            std::fabs(z - static_cast<double>(wall_z[nearest]))) {
            nearest = k;
        }
    }
    return nearest;
}

TEST(LayeredDepth, ContainsEveryPointSeenByAPatchCamera) {
    for (std::size_t patch = 0; patch < patch_count; ++patch) {
        const LayeredDepth layers = seen_spheres().patch(patch);
        const PictureMap map(layers.camera);
        std::size_t compared = 0;
        for (const std::size_t camera : seen_spheres().hemisphere.cameras_of(patch)) {
            const DepthPicture& picture = seen_spheres().pictures[camera];
            const PictureMap from(picture.camera);
            for (int y = 0; y < picture.camera.height; y += 3) {
                for (int x = 0; x < picture.camera.width; x += 3) {
                    const auto nearness = static_cast<double>(picture.nearness[picture.at(x, y)]);
                    if (nearness == 0.0) {
                        continue;
                    }
                    const glm::dvec3 point = from.point(x + 0.5, y + 0.5, nearness);
                    const auto place = map.project(point);
                    ASSERT_TRUE(place && place->x >= 0.0 && place->x < layers.camera.width &&
                                place->y >= 0.0 && place->y < layers.camera.height);
                    const int column = static_cast<int>(place->x);
                    const int row = static_cast<int>(place->y);
                    double least = std::numeric_limits<double>::infinity();
                    for (const DepthPixel& pixel : layers.at(column, row)) {
                        const double depth_off =
                            std::fabs(1.0 / static_cast<double>(pixel.nearness) - 1.0 / place->nearness);
                        least = std::min(least, depth_off);
                    }
                    // From the point to its pixel's middle along a slope of two steps, then half a step to one that is the same;
                    // a step is a pixel, of 1.6 mm on the plane, as a share of the distance to it.
                    const double steps = 2.0 * std::sqrt(0.5) + 0.5;
                    const double distance =
                        radius_m * glm::dot(seen_spheres().hemisphere.middle_of(patch),
                                            seen_spheres().hemisphere.image_plane_of(patch).normal);
                    EXPECT_LE(least, steps * 1.05 * view.pitch_m() / distance / place->nearness)
                        << patch << ", " << camera;
                    ++compared;
                }
            }
        }
        EXPECT_GT(compared, 15'000U);
    }
}

TEST(LayeredDepth, HoldsNoPointTwice) {
    const Seen seen(walls());
    for (std::size_t patch = 0; patch < patch_count; ++patch) {
        const LayeredDepth layers = seen.patch(patch);
        const PictureMap map(layers.camera);
        std::array<std::size_t, wall_z.size()> of_wall{};
        for (int y = 0; y < layers.camera.height; ++y) {
            for (int x = 0; x < layers.camera.width; ++x) {
                std::array<std::size_t, wall_z.size()> here{};
                float before = 0.0F;
                for (const DepthPixel& pixel : layers.at(x, y)) {
                    EXPECT_GT(pixel.nearness, before); // the farthest first
                    before = pixel.nearness;
                    const double z = map.point(x + 0.5, y + 0.5, static_cast<double>(pixel.nearness)).z;
                    const std::size_t wall = wall_of(z);
                    EXPECT_NEAR(z, static_cast<double>(wall_z[wall]), 1e-5); // 32 bits
                    EXPECT_EQ(pixel.colour.r, 50 + 50 * wall);
                    ++here[wall];
                    ++of_wall[wall];
                }
                EXPECT_LE(*std::max_element(here.begin(), here.end()), 1U);
            }
        }
        EXPECT_GT(*std::min_element(of_wall.begin(), of_wall.end()), 500U);
    }
}

TEST(LayeredDepth, DrawingOrderEqualsADepthTestForEyesAtEqualDepth) {
    // An eye beside the image's, at its distance: pixels move along their rows, or columns, alone. The walls move by several
    // pixels against each other.
    const Seen seen(walls());
    const LayeredDepth layers = single_ldi(seen.hemisphere, seen.pictures, view);
    std::size_t covered = 0;
    for (const glm::dvec3& beside : {glm::dvec3(0.2, 0.0, 0.0), glm::dvec3(-0.2, 0.0, 0.0),
                                     glm::dvec3(0.0, 0.15, 0.0), glm::dvec3(0.0, -0.15, 0.0)}) {
        DepthPicture by_order = empty_picture(glm::dvec3(0.0, 0.0, radius_m) + beside);
        DepthPicture by_depth = by_order;
        splat(layers, by_order);
        splat_by_depth(layers, by_depth);
        for (std::size_t pixel = 0; pixel < by_order.nearness.size(); ++pixel) {
            EXPECT_EQ(by_order.colours[pixel], by_depth.colours[pixel]);
            EXPECT_FLOAT_EQ(by_order.nearness[pixel], by_depth.nearness[pixel]);
            covered += by_order.colours[pixel].a != 0 ? 1 : 0;
        }
    }
    EXPECT_GT(covered, 20'000U);
}

TEST(LayeredDepth, DrawingOrderDiffersFromADepthTestOnlyAtSilhouettes) {
    std::mt19937 random(3);
    for (std::size_t patch = 0; patch < patch_count; ++patch) {
        const LayeredDepth layers = seen_spheres().patch(patch);
        for (int k = 0; k < 6; ++k) {
            const glm::dvec3 eye = eye_in(seen_spheres().hemisphere, patch, random);
            DepthPicture by_order = empty_picture(eye);
            DepthPicture by_depth = by_order;
            splat(layers, by_order);
            splat_by_depth(layers, by_depth);
            const Difference difference = compare(by_order, by_depth, 3); // a splat's size
            EXPECT_EQ(difference.unmatched, 0U) << patch << ": " << eye.x << ", " << eye.y << ", " << eye.z;
            EXPECT_EQ(difference.holes, 0U);
        }
    }
}

/// Over six eyes of each patch: fewer than one pixel in 200 may be empty where the world shows something, or show what the
/// world does not show within two pixels, as far as half a splat's size and a rounding.
template <typename Draw> void expect_like_the_world(const TriangleWorld& world, const Draw& draw_into) {
    std::mt19937 random(4);
    std::size_t holes = 0;
    std::size_t unmatched = 0;
    std::size_t compared = 0;
    for (std::size_t patch = 0; patch < patch_count; ++patch) {
        for (int k = 0; k < 6; ++k) {
            const glm::dvec3 eye = eye_in(seen_spheres().hemisphere, patch, random);
            DepthPicture picture = empty_picture(eye);
            draw_into(patch, picture);
            const Difference difference = compare(picture, drawn(world, eye), 2);
            holes += difference.holes;
            unmatched += difference.unmatched;
            compared += difference.compared;
        }
    }
    EXPECT_LT(holes, compared / 200);
    EXPECT_LT(unmatched, compared / 200);
    EXPECT_EQ(compared, std::size_t{54 * 128 * 128});
}

TEST(LayeredDepth, MatchesTheWorldFromEveryEyeOfItsPatch) {
    std::vector<LayeredDepth> patches;
    for (std::size_t patch = 0; patch < patch_count; ++patch) {
        patches.push_back(seen_spheres().patch(patch));
    }
    expect_like_the_world(spheres_before_a_wall(),
                          [&](std::size_t patch, DepthPicture& picture) { splat(patches[patch], picture); });
}

TEST(LayeredDepth, AdjacentPatchesMatchAtTheirBorder) {
    // Otherwise a window would flicker for an eye that crosses the border, or differ for two eyes on its sides.
    const Hemisphere& hemisphere = seen_spheres().hemisphere;
    std::vector<LayeredDepth> patches;
    for (std::size_t patch = 0; patch < patch_count; ++patch) {
        patches.push_back(seen_spheres().patch(patch));
    }
    std::size_t differ = 0;
    std::size_t compared = 0;
    const auto compare_at = [&](double polar_rad, double azimuth_rad, std::size_t a, std::size_t b) {
        const glm::dvec3 eye =
            radius_m * glm::dvec3(std::sin(polar_rad) * std::cos(azimuth_rad),
                                  std::sin(polar_rad) * std::sin(azimuth_rad), std::cos(polar_rad));
        DepthPicture of_a = empty_picture(eye);
        DepthPicture of_b = of_a;
        splat(patches[a], of_a);
        splat(patches[b], of_b);
        for (const Difference& difference : {compare(of_a, of_b, 2), compare(of_b, of_a, 2)}) {
            differ += difference.holes + difference.unmatched;
            compared += difference.compared;
        }
    };
    for (std::size_t patch = 1; patch < patch_count; ++patch) {
        const PatchDirections& ring = hemisphere.directions_of(patch);
        const double end = ring.middle_azimuth_rad + ring.half_width_rad;
        for (const double share : {0.2, 0.5, 0.8}) {
            compare_at(std::lerp(ring.min_polar_rad, ring.max_polar_rad, share), end, patch, patch % 8 + 1);
            compare_at(ring.min_polar_rad,
                       ring.middle_azimuth_rad + (2.0 * share - 1.0) * ring.half_width_rad, 0, patch);
        }
    }
    EXPECT_LT(differ, compared / 200);
    EXPECT_EQ(compared, std::size_t{2 * 48 * 128 * 128});
}

TEST(LayeredDepth, DepthMatchesTheWorld) {
    std::mt19937 random(6);
    TriangleWorld wall;
    add_rectangle(wall, {0.0F, 0.0F, -0.1F}, {0.6F, 0.6F}, {1, 2, 3});
    const Seen seen(wall);
    for (std::size_t patch = 0; patch < patch_count; ++patch) {
        const LayeredDepth layers = seen.patch(patch);
        const glm::dvec3 eye = eye_in(seen.hemisphere, patch, random);
        DepthPicture picture = empty_picture(eye);
        splat(layers, picture);
        std::size_t compared = 0;
        for (const float nearness :
             picture.nearness) { // the same everywhere, as the wall is parallel to the window
            if (nearness > 0.0F) {
                EXPECT_NEAR(static_cast<double>(nearness), eye.z / (eye.z + 0.1), 1e-5); // 32 bits
                ++compared;
            }
        }
        EXPECT_GT(compared, picture.nearness.size() * 199 / 200);
    }
}

TEST(LayeredDepth, LaterDrawnObjectIsOccludedCorrectly) {
    std::mt19937 random(8);
    TriangleWorld later;
    add_sphere(later, {0.01F, -0.01F, -0.05F}, 0.03F, {255, 255, 255});
    TriangleWorld both = spheres_before_a_wall();
    const auto first = static_cast<std::uint32_t>(both.positions.size());
    both.positions.insert(both.positions.end(), later.positions.begin(), later.positions.end());
    both.colours.insert(both.colours.end(), later.colours.begin(), later.colours.end());
    for (const std::uint32_t index : later.indices) {
        both.indices.push_back(first + index);
    }
    std::vector<LayeredDepth> patches;
    for (std::size_t patch = 0; patch < patch_count; ++patch) {
        patches.push_back(seen_spheres().patch(patch));
    }
    TriangleRasterizer rasterizer;
    std::size_t seen = 0;
    expect_like_the_world(both, [&](std::size_t patch, DepthPicture& picture) {
        splat(patches[patch], picture);
        rasterizer.draw(later, picture);
        seen += static_cast<std::size_t>(
            std::count(picture.colours.begin(), picture.colours.end(), glm::u8vec4(255)));
    });
    EXPECT_GT(seen, 10'000U);
}

TEST(LayeredDepth, ASecondPictureOfTheSameSizeKeepsItsMemory) {
    const LayeredDepth layers = seen_spheres().patch(3);
    DepthPicture picture = empty_picture({0.0, 0.3, 0.4});
    splat(layers, picture);
    const float* before = picture.nearness.data();
    picture.begin(camera_through_window({0.1, 0.2, 0.4}, view.half_extent_m, view.width, view.height));
    splat(layers, picture);
    EXPECT_EQ(picture.nearness.data(), before);
}

TEST(LayeredDepth, DrawsNothingIfEmptyOrFromAnInvalidEye) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const Seen nothing(TriangleWorld{});
    const LayeredDepth empty = nothing.patch(2);
    EXPECT_TRUE(empty.pixels.empty());
    const LayeredDepth layers = seen_spheres().patch(0);
    const ImageBasedObject object = image_based_object(TriangleWorld{}, radius_m, view);
    for (const glm::dvec3& eye :
         {glm::dvec3(0.0, 0.0, 0.5), glm::dvec3(0.0), glm::dvec3(0.1, 0.0, 0.0), glm::dvec3(0.0, 0.0, -0.5),
          glm::dvec3(0.0, 0.0, 1e-300), glm::dvec3(nan, 0.0, 0.5), glm::dvec3(0.0, 0.0, nan)}) {
        DepthPicture picture = empty_picture(eye);
        splat(empty, picture);
        splat(object, picture);
        if (!(eye.z > 1e-200) || std::isnan(eye.x)) {
            splat(layers, picture);
        }
        EXPECT_EQ(std::count(picture.nearness.begin(), picture.nearness.end(), 0.0F), 128 * 128);
    }
}

TEST(Peers, SingleLayeredImageMatchesTheWorld) {
    const LayeredDepth layers = single_ldi(seen_spheres().hemisphere, seen_spheres().pictures, view);
    expect_like_the_world(spheres_before_a_wall(),
                          [&](std::size_t, DepthPicture& picture) { splat(layers, picture); });
}

TEST(Peers, ImageBasedObjectMatchesTheWorldWithAtMostThreeSides) {
    TriangleWorld world = spheres_before_a_wall();
    for (std::size_t corner = 0; corner < 4;
         ++corner) { // a smaller wall, so that pixels on the box are as fine as the window's
        world.positions[corner] *= glm::vec3(0.3F, 0.3F, 1.0F);
    }
    const ImageBasedObject object = image_based_object(world, radius_m, view);
    std::array<std::size_t, 4> counts{};
    expect_like_the_world(world, [&](std::size_t, DepthPicture& picture) {
        splat(object, picture);
        const SeenSides seen = seen_sides(object, picture.camera.eye);
        ASSERT_LE(seen.count, 3U);
        ++counts[seen.count];
        for (std::size_t k = 0; k < seen.count;
             ++k) { // before the side, which is a side of the box of all positions
            const ImageBasedObject::Side& side = object.sides[seen.numbers[k]];
            EXPECT_GT(glm::dot(side.outwards, picture.camera.eye - side.middle), 0.0);
            for (const glm::vec3& position : world.positions) {
                EXPECT_LE(glm::dot(side.outwards, glm::dvec3(position) - side.middle), 1e-12);
            }
        }
    });
    EXPECT_GT(counts[2] + counts[3], 10U);
}

} // namespace
} // namespace frustumscreen::ldi
