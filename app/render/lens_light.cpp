#include "app/render/lens_light.h"

#include <cmath>
#include <numbers>

namespace frustumscreen {

namespace {

constexpr std::size_t count = lens_light_terms;

glm::dvec3 exact(const Lens& lens, double real_r2) {
    const double real = std::sqrt(real_r2);
    const double ideal = lens.undistort({real, 0.0}).value_or(glm::dvec2(real, 0.0)).x;
    const double share = 1.0 / lens.area_factor(ideal * ideal);
    return {real > 0.0 ? ideal / real : 1.0, share, std::pow(share, 1.0 / 2.4)};
}

/// r^2 of the farthest pixel, as the lens bends it.
double farthest_real_r2(const Pinhole& pinhole) {
    const glm::dvec2 most(std::fmax(pinhole.cx, pinhole.width - pinhole.cx) / pinhole.fx,
                          std::fmax(pinhole.cy, pinhole.height - pinhole.cy) / pinhole.fy);
    return glm::dot(most, most);
}

} // namespace

LensLight lens_light(const Pinhole& pinhole) {
    const double farthest_r2 = farthest_real_r2(pinhole);
    std::array<glm::dvec3, count> chebyshev{}; // coefficients of Chebyshev's polynomials
    for (std::size_t j = 0; j < count; ++j) {
        const double angle = std::numbers::pi * (static_cast<double>(j) + 0.5) / static_cast<double>(count);
        const glm::dvec3 value = exact(pinhole.lens, 0.5 * (std::cos(angle) + 1.0) * farthest_r2);
        for (std::size_t k = 0; k < count; ++k) {
            const double weight = (k == 0 ? 1.0 : 2.0) / static_cast<double>(count);
            chebyshev[k] += weight * std::cos(static_cast<double>(k) * angle) * value;
        }
    }
    // Their own coefficients: T(k + 1) = 2 x T(k) - T(k - 1).
    std::array<double, count> before{}, now{};
    now[0] = 1.0;
    std::array<glm::dvec3, count> terms{};
    for (std::size_t k = 0; k < count; ++k) {
        for (std::size_t power = 0; power < count; ++power) {
            terms[power] += now[power] * chebyshev[k];
        }
        std::array<double, count> next{};
        for (std::size_t power = 0; power < count; ++power) {
            const double lower = power > 0 ? now[power - 1] : 0.0;
            next[power] = (k == 0 ? 1.0 : 2.0) * lower - before[power];
        }
        before = now;
        now = next;
    }
    LensLight light{static_cast<float>(2.0 / farthest_r2), {}};
    for (std::size_t k = 0; k < count; ++k) {
        light.terms[k] = glm::vec3(terms[k]);
    }
    return light;
}

} // namespace frustumscreen
