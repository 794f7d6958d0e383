/// What the evenness of light needs of a projector's lens at each fragment, as polynomials: neither steps of Newton's nor a power there.
///
///     (inward, share, code share) = sum over k of terms[k] x^k,  x = scale r^2 - 1, r a pixel's direction as the lens bends it
///
/// inward       takes that direction to the ideal one.
/// share        of an ideal pixel's light that the pixel sends: 1 / Lens::area_factor.
/// code share   that, to the power of 1 / 2.4: what codes are multiplied by.
///
/// Exact at Chebyshev's nodes over the picture. With |k1| <= .12 they follow the lens to 1.2e-7 where the picture reaches r = .49, as the
/// shipped one, and to 2e-4 where it reaches .98: a twentieth of a code.
/// Units        r in focal lengths.
/// Threads      values; any.
#pragma once

#include "app/geometry/pinhole.h"

#include <array>

namespace frustumscreen {

inline constexpr std::size_t lens_light_terms = 8;

struct LensLight {
    float scale = 0.0F;
    std::array<glm::vec3, lens_light_terms> terms{};
};
/// `pinhole`: its picture lies before the lens's fold.
[[nodiscard]] LensLight lens_light(const Pinhole& pinhole);

} // namespace frustumscreen
