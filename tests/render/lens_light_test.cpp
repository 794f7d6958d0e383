// What the light needs of a lens, against the lens itself: Newton's method and the derivative of the distortion by differences.
#include "app/render/lens_light.h"

#include <gtest/gtest.h>

#include <cmath>

namespace frustumscreen {
namespace {

Pinhole shipped_with(const Lens& lens) {
    return {1920, 1200, 2300.0, 2300.0, 960.0, 600.0, lens};
}

glm::vec3 value_at(const LensLight& light, double r) {
    const auto x = static_cast<float>(r * r) * light.scale - 1.0F;
    glm::vec3 sum(0.0F);
    for (std::size_t k = light.terms.size(); k-- > 0;) {
        sum = sum * x + light.terms[k];
    }
    return sum;
}

/// The area of a small square around an ideal direction, as the lens bends it, over its own.
double area_by_differences(const Lens& lens, double ideal) {
    constexpr double step = 1e-5;
    const glm::dvec2 along = *lens.distort({ideal + step, 0.0}) - *lens.distort({ideal - step, 0.0});
    const glm::dvec2 across = *lens.distort({ideal, step}) - *lens.distort({ideal, -step});
    return (along.x * across.y - along.y * across.x) / (4.0 * step * step);
}

/// The largest relative error over the picture.
double worst_of(const Pinhole& pinhole) {
    const LensLight light = lens_light(pinhole);
    const double corner = std::hypot(0.5 * pinhole.width / pinhole.fx, 0.5 * pinhole.height / pinhole.fy);
    double worst = 0.0;
    for (int k = 1; k <= 1000; ++k) {
        const double real = corner * k / 1000.0;
        const double ideal = pinhole.lens.undistort({real, 0.0})->x;
        const double share = 1.0 / area_by_differences(pinhole.lens, ideal);
        const glm::dvec3 off =
            glm::dvec3(value_at(light, real)) / glm::dvec3(ideal / real, share, std::pow(share, 1.0 / 2.4));
        worst = std::fmax(
            worst, std::fmax(std::abs(off.x - 1.0), std::fmax(std::abs(off.y - 1.0), std::abs(off.z - 1.0))));
    }
    return worst;
}

TEST(LensLight, FollowsTheLensOverThePicture) {
    for (const Lens& lens : {Lens{0.1, 0.0}, Lens{-0.12, 0.0}, Lens{0.05, -0.02}, Lens{-0.1, 0.03}}) {
        EXPECT_LT(worst_of(shipped_with(lens)), 1e-6) << lens.k1 << ", " << lens.k2;
    }
    const Pinhole wide{1920,  1200,  1150.0,      1150.0,
                       960.0, 600.0, {-0.12, 0.0}}; // its corners are .98 focal lengths out
    EXPECT_LT(worst_of(wide), 1e-3);
}

TEST(LensLight, OfAPlainLensIsOne) {
    const LensLight light = lens_light(shipped_with({}));
    for (const double r : {0.0, 0.2, 0.49}) {
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(value_at(light, r)[k], 1.0F, 1e-6F);
        }
    }
}

} // namespace
} // namespace frustumscreen
