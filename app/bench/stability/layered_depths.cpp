// A window whose world is layered depth images: the eye on its plane and behind it, right before it and a million kilometres away, at an
// image's own eye; surfaces around the eye; depths that differ a millionfold; worlds that no eye sees.

#include "app/bench/stability/exact.h"
#include "app/bench/stability/sweep.h"
#include "app/bench/stability/themes.h"
#include "app/ldi/peers.h"
#include "app/ldi/triangle_rasterizer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace frustumscreen::bench {

namespace {

using exact::Real;

constexpr double rounding = 0x1p-24; ///< of 32 bits
constexpr double radius_m = 0.5;
const ldi::CameraView view{
    .half_extent_m = {0.1, 0.1}, .width = 64, .height = 64, .margin = 1.5, .max_side = 256};

/// Adds a square wall parallel to the window.
void add_wall(ldi::TriangleWorld& world, double z, double half_extent_m) {
    const auto first = static_cast<std::uint32_t>(world.positions.size());
    for (const glm::dvec2& corner :
         {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)}) {
        world.positions.emplace_back(half_extent_m * glm::dvec3(corner, 0.0) + glm::dvec3(0.0, 0.0, z));
    }
    for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) {
        world.indices.push_back(first + corner);
    }
}

ldi::TriangleWorld walls() {
    ldi::TriangleWorld world;
    add_wall(world, -0.1, 0.3);
    add_wall(world, 0.02, 0.02);
    return world;
}

struct Seen {
    ldi::Hemisphere hemisphere{radius_m};
    std::array<ldi::DepthPicture, ldi::camera_count> pictures;
    std::vector<ldi::LayeredDepth> images; ///< one for each patch; the last one has all cameras

    explicit Seen(const ldi::TriangleWorld& world) {
        ldi::TriangleRasterizer rasterizer;
        for (std::size_t camera = 0; camera < ldi::camera_count; ++camera) {
            pictures[camera].begin(ldi::camera_at(view, hemisphere.cameras()[camera]));
            rasterizer.draw(world, pictures[camera]);
        }
        for (std::size_t patch = 0; patch < ldi::patch_count; ++patch) {
            images.push_back(ldi::patch_layers(hemisphere, patch, pictures, view));
        }
        images.push_back(ldi::single_ldi(hemisphere, pictures, view));
    }
};

ldi::DepthPicture picture_for(const glm::dvec3& eye) {
    ldi::DepthPicture picture;
    picture.begin(ldi::camera_through_window(eye, view.half_extent_m, view.width, view.height));
    return picture;
}

double covered(const ldi::DepthPicture& picture) {
    return static_cast<double>(picture.nearness.size()) -
           static_cast<double>(std::count(picture.nearness.begin(), picture.nearness.end(), 0.0F));
}

/// The number of pixels that all techniques together draw for an eye.
double covered_by_all(const ldi::TriangleWorld& world, const Seen& seen, const ldi::ImageBasedObject& object,
                      const glm::dvec3& eye) {
    ldi::DepthPicture picture = picture_for(eye);
    ldi::TriangleRasterizer().draw(world, picture);
    for (const ldi::LayeredDepth& image : seen.images) {
        ldi::splat(image, picture);
    }
    ldi::splat(object, picture);
    return covered(picture);
}

StabilityResult on_the_plane_and_behind(const StabilityOptions&) {
    const ldi::TriangleWorld world = walls();
    const Seen seen(world);
    const ldi::ImageBasedObject object = ldi::image_based_object(world, radius_m, view);
    double drawn = 0.0;
    double in_a_patch = 0.0;
    for (const double z : {1e-300, 0.0, -1e-300, -1e-12, -1e-3, -0.1, -2.0, -1e9, -1e300}) {
        for (const glm::dvec2& beside : {glm::dvec2(0.0), glm::dvec2(0.05, -0.1), glm::dvec2(0.3, 0.1)}) {
            const glm::dvec3 eye(beside, z);
            drawn += covered_by_all(world, seen, object, eye);
            in_a_patch += seen.hemisphere.patch_of(eye).has_value() && !(z > 0.0 && beside == glm::dvec2(0.0))
                              ? 1.0
                              : 0.0;
        }
    }
    const double control = covered_by_all(world, seen, object, {0.0, 0.0, radius_m});
    return {
        {{"pixels drawn", 0.0, drawn},
         {"eyes with a patch", 0.0, in_a_patch},
         {"pixels drawn for an eye before it, short of all", 0.0, std::fmax(0.0, 64.0 * 64.0 - control)}}};
}

/// A wall parallel to the window has the same nearness in all pixels. It rounds in 32 bits, as its distances do in
/// `world.positions`.
StabilityResult eyes(const StabilityOptions&) {
    ldi::TriangleWorld world;
    add_wall(world, -0.1, 1e10);
    double off = 0.0;
    double holes = 0.0;
    for (const double z : sweep(1e-3, 1e8, 10)) {
        for (const glm::dvec2& lean : {glm::dvec2(0.0), glm::dvec2(0.5, -1.0)}) {
            ldi::DepthPicture picture = picture_for(z * glm::dvec3(lean, 1.0));
            ldi::TriangleRasterizer().draw(world, picture);
            holes += 64.0 * 64.0 - covered(picture);
            const Real truth = Real(z) / (Real(z) - Real(world.positions.front().z));
            for (const float nearness : picture.nearness) {
                off = std::fmax(off, double(std::fabs(Real(nearness) / truth - 1)));
            }
        }
    }
    return {{{"nearness of a wall off, relative", 4.0 * rounding, off}, {"pixels without it", 0.0, holes}}};
}

/// A floor reaches below the eye, from far behind it to far before it. A corner rounds by half of 1/1024 pixel. Where the floor is cut,
/// 8190 pixels away, its nearness rounds by 2^-24 of that of 8190 pixels. Both corners of a side round so.
StabilityResult around_the_eye(const StabilityOptions&) {
    double off = 0.0;
    double wrong = 0.0;
    double compared = 0.0;
    for (const double below_m : {1e-4, 1e-2, 0.1, 1.0}) {
        ldi::TriangleWorld world;
        world.positions = {{-1e4F, 0.0F, 30.0F}, {1e4F, 0.0F, 30.0F}, {0.0F, 0.0F, -1e6F}};
        world.indices = {0, 1, 2};
        for (glm::vec3& position : world.positions) {
            position.y = static_cast<float>(-below_m);
        }
        const glm::dvec3 eye(0.01, 0.02, radius_m);
        ldi::DepthPicture picture = picture_for(eye);
        ldi::TriangleRasterizer().draw(world, picture);
        const Real height = Real(eye.y) - Real(world.positions.front().y);
        for (int y = 0; y < 64; ++y) {
            // The pixel's ray falls by `falls` in a window's distance, so it meets the floor at height / falls window distances.
            const Real falls = Real(eye.y) - Real(0.1) * (1 - Real(2 * y + 1) / 64);
            const Real per_px = Real(0.2) / 64 / height; // of the nearness
            const Real from_horizon_px = falls / height / per_px;
            for (int x = 8; x < 56; ++x) {
                const Real nearness = picture.nearness[picture.at(x, y)];
                if (std::fabs(from_horizon_px) > Real(0.01)) {
                    wrong += (nearness > 0) == (from_horizon_px > 0) ? 0.0 : 1.0;
                }
                if (nearness > 0 && from_horizon_px > 0) {
                    off = std::fmax(off, double(std::fabs(nearness - falls / height) / per_px));
                    compared += 1.0;
                }
            }
        }
    }
    return {{{"floor: nearness off, in pixels of its slope", 1.0 / 1024.0 + 2.0 * 8190.0 * rounding, off},
             {"floor: pixels above the horizon, or missing below it", 0.0, wrong},
             {"floor: pixels compared, short of 5000", 0.0, std::fmax(0.0, 5000.0 - compared)}}};
}

/// Each world has three walls, at a millionth, a thousandth and all of the depth; a camera sees all of them. In 32 bits a wall's nearness
/// rounds in the camera's picture, its slope rounds twice, the nearness rounds again when it moves along that slope in the image, and
/// once more in the picture. With the walls' own place these are six roundings. A slope counts twice on a plane that leans by 60 degrees.
StabilityResult depths(const StabilityOptions&) {
    StabilityResult result;
    for (const double nearest_m : {1e-6, 1e-3, 1.0}) {
        ldi::TriangleWorld world;
        const std::array<double, 3> depths_m{nearest_m, 1e3 * nearest_m, 1e6 * nearest_m};
        for (std::size_t k = 0; k < 3;
             ++k) { // a third as wide as the visible part at its depth; the last one as wide as all of it
            add_wall(world, -depths_m[k],
                     k == 2 ? 10.0 * depths_m[k] + 10.0
                            : 0.03 * (radius_m + depths_m[k]) * static_cast<double>(1 + k));
        }
        const Seen seen(world);
        double off = 0.0;
        std::array<double, 3> of_wall{};
        for (std::size_t patch = 0; patch < ldi::patch_count; ++patch) {
            const glm::dvec3 eye = 1.1 * radius_m * seen.hemisphere.middle_of(patch);
            ldi::DepthPicture picture = picture_for(eye);
            ldi::splat(seen.images[patch], picture);
            for (const float nearness : picture.nearness) {
                double least = 1.0;
                for (std::size_t k = 0; nearness > 0.0F && k < 3; ++k) {
                    const Real truth = Real(eye.z) / (Real(eye.z) - Real(world.positions[4 * k].z));
                    const double here = double(std::fabs(Real(nearness) / truth - 1));
                    of_wall[k] += here < 1e-3 ? 1.0 : 0.0;
                    least = std::fmin(least, here);
                }
                off = nearness > 0.0F ? std::fmax(off, least) : off;
            }
        }
        const std::string where = fmt::format("{:g} to {:g} m: ", depths_m[0], depths_m[2]);
        result.rows.push_back({where + "nearness off, relative", 2.0 * 6.0 * rounding, off});
        result.rows.push_back({where + "walls seen, short of 3", 0.0,
                               static_cast<double>(std::count(of_wall.begin(), of_wall.end(), 0.0))});
    }
    return result;
}

/// Counts pixels whose nearness occurs nowhere within two pixels in another picture. Two pixels: half a splat's size and a rounding.
double unmatched_pixels(const ldi::DepthPicture& picture, const ldi::DepthPicture& other) {
    double count = 0.0;
    for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) {
            float least = 1.0F;
            for (int v = std::max(0, y - 2); v <= std::min(y + 2, view.height - 1); ++v) {
                for (int u = std::max(0, x - 2); u <= std::min(x + 2, view.width - 1); ++u) {
                    least = std::fmin(least, std::fabs(other.nearness[other.at(u, v)] -
                                                       picture.nearness[picture.at(x, y)]));
                }
            }
            count += least > 1e-6F ? 1.0 : 0.0;
        }
    }
    return count;
}

/// The side of the epipole decides which of two splats at a silhouette is drawn last. At the image's own eye the epipole is 0 / 0; beside
/// that eye it is infinitely far away.
StabilityResult at_the_images_eye(const StabilityOptions&) {
    const Seen seen(walls());
    double differs = 0.0;
    for (std::size_t image = 0; image < seen.images.size(); ++image) {
        const glm::dvec3 own = seen.images[image].camera.eye;
        ldi::DepthPicture still = picture_for(own);
        ldi::splat(seen.images[image], still);
        for (const double way_m : {1e-300, 1e-17, 1e-15, 1e-12}) {
            for (const glm::dvec3& towards :
                 {glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(1.0, 0.0, 0.0),
                  glm::dvec3(0.0, -1.0, 0.0), glm::dvec3(-1.0, 1.0, 1.0)}) {
                ldi::DepthPicture moved = picture_for(own + way_m * towards);
                ldi::splat(seen.images[image], moved);
                differs += unmatched_pixels(moved, still);
            }
        }
    }
    return {{{"up to 1e-12 m beside it: surfaces not shown within 2 px", 0.0, differs}}};
}

StabilityResult nothing_seen(const StabilityOptions&) {
    double pixels = 0.0;
    double drawn = 0.0;
    std::array<ldi::TriangleWorld, 4> worlds;
    add_wall(worlds[1], 2.0, 10.0); // behind all eyes
    worlds[2].positions = {
        {5.0F, 0.0F, -0.1F}, {5.0F, 1.0F, -0.1F}, {6.0F, 0.0F, -0.1F}}; // beside the window
    worlds[2].indices = {0, 1, 2};
    worlds[3].positions = {{0.0F, 0.0F, -0.1F}, {0.0F, 0.0F, -0.1F}, {0.01F, 0.0F, -0.1F}}; // no area
    worlds[3].indices = {0, 1, 2, 0, 1, 7};
    for (const ldi::TriangleWorld& world : worlds) {
        const Seen seen(world);
        for (const ldi::LayeredDepth& image : seen.images) {
            pixels += static_cast<double>(image.pixels.size());
            ldi::DepthPicture picture = picture_for({0.0, 0.0, radius_m});
            ldi::splat(image, picture);
            drawn += covered(picture);
        }
    }
    return {{{"surface points of an image", 0.0, pixels}, {"pixels drawn", 0.0, drawn}}};
}

/// The patch of an eye follows from cosines and an azimuth that round four times.
StabilityResult patches(const StabilityOptions&) {
    const ldi::Hemisphere hemisphere(radius_m);
    std::mt19937 random(49);
    std::normal_distribution<double> u;
    double mistaken = 0.0;
    double compared = 0.0;
    for (const double away_m : {1e-300, 1e-6, 1.0, 1e6, 1e300}) {
        for (int k = 0; k < 5000; ++k) {
            const glm::dvec3 eye = away_m * glm::dvec3(u(random), u(random), u(random)) / 8.0;
            const Real x = Real(eye.x) / Real(away_m);
            const Real y = Real(eye.y) / Real(away_m);
            const Real z = Real(eye.z) / Real(away_m);
            const Real cosine = z / std::sqrt(x * x + y * y + z * z);
            const Real widths = std::atan2(y, x) / (std::numbers::pi_v<Real> / 4) + Real(0.5);
            if (std::fabs(cosine - Real(0.5)) < 1e-15L || std::fabs(cosine - Real(17) / 18) < 1e-15L ||
                std::fabs(widths - std::round(widths)) < 1e-14L) {
                continue;
            }
            const auto patch = hemisphere.patch_of(eye);
            const std::size_t ring = 1 + (static_cast<std::size_t>(std::floor(widths) + 8) % 8);
            const std::size_t truth = cosine > Real(17) / 18 ? 0 : ring;
            mistaken += patch.has_value() == (cosine > Real(0.5)) && (!patch || *patch == truth) ? 0.0 : 1.0;
            compared += 1.0;
        }
    }
    return {{{"patches mistaken, 1e-15 beside their borders", 0.0, mistaken},
             {"eyes compared, short of 24000", 0.0, std::fmax(0.0, 24000.0 - compared)}}};
}

} // namespace

std::vector<StabilityCase> layered_depth_cases() {
    constexpr std::string_view theme = "layered depth";
    std::vector<StabilityCase> cases;
    const auto add = [&](std::string name, StabilityResult (*measure)(const StabilityOptions&)) {
        cases.push_back({std::string(theme), std::move(name), FloatingPoint::Strict, measure});
    };
    add("an eye on its plane and behind it", on_the_plane_and_behind);
    add("eyes at 1 mm to 100000 km", eyes);
    add("a floor around the eye", around_the_eye);
    add("depths that differ a millionfold", depths);
    add("at an image's own eye", at_the_images_eye);
    add("worlds of which nothing is seen", nothing_seen);
    add("patches from any distance", patches);
    return cases;
}

} // namespace frustumscreen::bench
