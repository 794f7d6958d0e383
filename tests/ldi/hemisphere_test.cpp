// The hemisphere's patches and cameras against Monte Carlo integration and plain trigonometry.
#include "app/ldi/hemisphere.h"
#include "tests/folders.h"
#include "tests/ldi/hemisphere_drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace frustumscreen::ldi {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

glm::dvec3 direction(double polar_rad, double azimuth_rad) {
    return {std::sin(polar_rad) * std::cos(azimuth_rad), std::sin(polar_rad) * std::sin(azimuth_rad),
            std::cos(polar_rad)};
}

TEST(Hemisphere, NinePatchesShareTheCapEqually) {
    for (const double cap_rad : {default_cap_rad, two_thirds_cap_rad}) {
        const Hemisphere hemisphere(0.5, cap_rad);
        std::mt19937 random(1);
        std::uniform_real_distribution<double> height(0.0, 1.0); // equal areas of a sphere (Archimedes)
        std::uniform_real_distribution<double> azimuth(-std::numbers::pi, std::numbers::pi);
        std::array<double, patch_count> inside{};
        constexpr int count = 400'000;
        for (int k = 0; k < count; ++k) {
            if (const auto patch =
                    hemisphere.patch_of(3.0 * direction(std::acos(height(random)), azimuth(random)))) {
                inside[*patch] += 1.0;
            }
        }
        const double share = (1.0 - std::cos(0.5 * cap_rad)) / patch_count; // of the hemisphere, each patch
        const double deviation = std::sqrt(share * (1.0 - share) / count);
        for (const double in_patch : inside) {
            EXPECT_NEAR(in_patch / count, share, 5.0 * deviation);
        }
    }
    EXPECT_NEAR(1.0 - std::cos(0.5 * default_cap_rad), 0.5, 1e-12);
    EXPECT_NEAR(1.0 - std::cos(0.5 * two_thirds_cap_rad), 2.0 / 3.0, 1e-12);
}

TEST(Hemisphere, PatchBordersAreExactToAMillionthOfADegree) {
    const Hemisphere hemisphere(0.7);
    constexpr double beside = 1e-6 * degree;
    const double centre_rad = std::acos(17.0 / 18.0); // a ninth of half the hemisphere
    for (int step = 0; step < 720; ++step) {
        const double azimuth = (0.5 * step + 0.1) * degree; // not on a border of two ring patches
        const auto ring = static_cast<std::size_t>(std::floor(azimuth / (45.0 * degree) + 0.5)) % 8 + 1;
        EXPECT_EQ(hemisphere.patch_of(direction(centre_rad - beside, azimuth)), 0U);
        EXPECT_EQ(hemisphere.patch_of(direction(centre_rad + beside, azimuth)), ring);
        EXPECT_EQ(hemisphere.patch_of(direction(60.0 * degree - beside, azimuth)), ring);
        EXPECT_FALSE(hemisphere.patch_of(direction(60.0 * degree + beside, azimuth)));
    }
    for (std::size_t patch = 1; patch < patch_count; ++patch) {
        const double end = (45.0 * static_cast<double>(patch - 1) + 22.5) * degree;
        for (const double polar_deg : {20.0, 40.0, 59.0}) {
            const double across = beside / std::sin(polar_deg * degree); // of azimuth
            EXPECT_EQ(hemisphere.patch_of(direction(polar_deg * degree, end - across)), patch);
            EXPECT_EQ(hemisphere.patch_of(direction(polar_deg * degree, end + across)), patch % 8 + 1);
        }
    }
}

TEST(Hemisphere, PatchOfAnEyeDoesNotDependOnItsDistance) {
    const Hemisphere hemisphere(0.4);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    int compared = 0;
    for (int k = 0; k < 20'000; ++k) {
        const glm::dvec3 eye(u(random), u(random), std::fabs(u(random)) + 1e-3);
        const double polar = std::atan2(std::hypot(eye.x, eye.y), eye.z);
        if (std::fabs(polar - 60.0 * degree) < 1e-6 * degree) {
            continue;
        }
        const auto patch = hemisphere.patch_of(eye);
        EXPECT_EQ(patch.has_value(), polar < 60.0 * degree);
        for (const double scale : {1e-200, 1e-6, 1e6, 1e200}) {
            EXPECT_EQ(hemisphere.patch_of(scale * eye), patch);
        }
        if (patch) {
            const PatchDirections& bound = hemisphere.directions_of(*patch);
            EXPECT_LE(std::acos(glm::dot(glm::normalize(eye), bound.axis)), bound.cone_rad);
            EXPECT_GE(polar, bound.min_polar_rad - 1e-12);
            EXPECT_LE(polar, bound.max_polar_rad + 1e-12);
            EXPECT_LE(std::fabs(std::remainder(std::atan2(eye.y, eye.x) - bound.middle_azimuth_rad,
                                               2.0 * std::numbers::pi)),
                      bound.half_width_rad + 1e-12);
            ++compared;
        }
    }
    EXPECT_GT(compared, 5000);
}

TEST(Hemisphere, EyeBehindTheWindowOrNotFiniteHasNoPatch) {
    const Hemisphere hemisphere(0.4);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& eye :
         {glm::dvec3(0.0), glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 0.0, nan),
          glm::dvec3(nan, 0.0, 1.0), glm::dvec3(0.0, 0.0, infinity), glm::dvec3(infinity, 0.0, 1.0)}) {
        EXPECT_FALSE(hemisphere.patch_of(eye));
    }
}

TEST(Hemisphere, CamerasLieOnTheSphereWithinTheirPatches) {
    for (const double cap_rad : {0.3, default_cap_rad, two_thirds_cap_rad, max_cap_rad}) {
        const Hemisphere hemisphere(0.45, cap_rad);
        std::set<std::size_t> own;
        for (std::size_t patch = 0; patch < patch_count; ++patch) {
            EXPECT_EQ(hemisphere.own_cameras_of(patch).size(), patch == 0 ? 5U : 3U);
            for (const std::size_t camera : hemisphere.own_cameras_of(patch)) {
                EXPECT_NEAR(glm::length(hemisphere.cameras()[camera]), 0.45, 1e-15);
                EXPECT_EQ(hemisphere.patch_of(hemisphere.cameras()[camera]), patch);
                EXPECT_TRUE(own.insert(camera).second);
            }
        }
        EXPECT_EQ(own.size(), camera_count);
    }
}

/// The least angle between a camera and the directions that two patches have in common, by sampling them.
double angle_to_border(const Hemisphere& hemisphere, const glm::dvec3& camera, std::size_t a, std::size_t b) {
    const PatchDirections& of_a = hemisphere.directions_of(a);
    const PatchDirections& of_b = hemisphere.directions_of(b);
    double least = 10.0;
    for (int k = 0; k <= 400; ++k) {
        const double share = k / 400.0;
        const PatchDirections& ring = a == 0 ? of_b : of_a;
        const bool of_centre = a == 0 || b == 0;
        const double turn =
            std::remainder(of_b.middle_azimuth_rad - of_a.middle_azimuth_rad, 2.0 * std::numbers::pi);
        const double polar =
            of_centre ? ring.min_polar_rad : std::lerp(ring.min_polar_rad, ring.max_polar_rad, share);
        const double azimuth =
            ring.middle_azimuth_rad +
            ring.half_width_rad * (of_centre ? 2.0 * share - 1.0 : std::copysign(1.0, turn));
        least = std::min(least, std::acos(glm::dot(glm::normalize(camera), direction(polar, azimuth))));
    }
    return least;
}

TEST(Hemisphere, PatchUsesTheNearestCameraOfEachNeighbour) {
    const Hemisphere hemisphere(0.5);
    for (std::size_t patch = 0; patch < patch_count; ++patch) {
        const auto seeing = hemisphere.cameras_of(patch);
        EXPECT_EQ(std::set<std::size_t>(seeing.begin(), seeing.end()).size(), patch == 0 ? 13U : 6U);
        std::size_t shared = 0;
        for (const std::size_t neighbour : hemisphere.neighbours_of(patch)) {
            double nearest = 10.0;
            double borrowed = 10.0;
            for (const std::size_t camera : hemisphere.own_cameras_of(neighbour)) {
                const double angle =
                    angle_to_border(hemisphere, hemisphere.cameras()[camera], patch, neighbour);
                nearest = std::min(nearest, angle);
                if (std::find(seeing.begin(), seeing.end(), camera) != seeing.end()) {
                    borrowed = std::min(borrowed, angle);
                    ++shared;
                }
            }
            EXPECT_NEAR(borrowed, nearest, 1e-3) << patch << " of " << neighbour;
        }
        EXPECT_EQ(shared + hemisphere.own_cameras_of(patch).size(), seeing.size());
    }
}

TEST(Hemisphere, NoDirectionOfTheCapIsFarFromACamera) {
    const Hemisphere hemisphere(1.0);
    double farthest = 0.0;
    for (double polar_deg = 0.0; polar_deg <= 60.0; polar_deg += 0.5) {
        for (double azimuth_deg = 0.0; azimuth_deg < 360.0; azimuth_deg += 0.5) {
            double nearest = 10.0;
            for (const glm::dvec3& camera : hemisphere.cameras()) {
                nearest = std::min(
                    nearest, std::acos(std::min(1.0, glm::dot(camera, direction(polar_deg * degree,
                                                                                azimuth_deg * degree)))));
            }
            farthest = std::max(farthest, nearest);
        }
    }
    EXPECT_LE(farthest, 14.2 * degree);
}

TEST(Hemisphere, ImagePlaneIsParallelToTheCamerasOfItsPatch) {
    for (const double cap_rad : {default_cap_rad, two_thirds_cap_rad}) {
        const Hemisphere hemisphere(0.6, cap_rad);
        for (std::size_t patch = 0; patch < patch_count; ++patch) {
            const ImagePlane plane = hemisphere.image_plane_of(patch);
            EXPECT_NEAR(glm::length(plane.normal), 1.0, 1e-15);
            EXPECT_NEAR(glm::length(glm::cross(plane.right, plane.up) - plane.normal), 0.0, 1e-15);
            EXPECT_GT(plane.normal.z, 0.0);
            const auto own = hemisphere.own_cameras_of(patch);
            const std::size_t first =
                patch == 0 ? 1 : 0; // the camera on the axis is nearer than the plane of the others
            for (std::size_t k = first + 1; k < own.size(); ++k) {
                EXPECT_NEAR(
                    glm::dot(plane.normal, hemisphere.cameras()[own[k]] - hemisphere.cameras()[own[first]]),
                    0.0, 1e-15);
            }
            EXPECT_LT(std::acos(glm::dot(plane.normal, hemisphere.middle_of(patch))), 15.0 * degree);
        }
    }
}

TEST(Hemisphere, DrawingInDocsIsCurrent) {
    const std::string drawing = svg_of(Hemisphere(1.0));
    if (const char* const file = std::getenv("HEMISPHERE_DRAWING"); file != nullptr) {
        std::ofstream(file) << drawing;
    }
    std::ifstream page(source_dir() + "/docs/ldi.svg");
    std::ostringstream kept;
    kept << page.rdbuf();
    EXPECT_TRUE(kept.str() == drawing)
        << "HEMISPHERE_DRAWING=docs/ldi.svg build/release/tests/ldi_test writes it";
}

} // namespace
} // namespace frustumscreen::ldi
