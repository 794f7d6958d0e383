/// Radial distortion of a projector's or a camera's lens: x' = x (1 + k1 r^2 + k2 r^4), r^2 = |x|^2.
///
/// Frame    x is a direction's (X / Z, Y / Z) in the pinhole's frame; a pixel is fx x' + cx, fy y' + cy.
/// Errors   no result beyond the fold, where the lens would map a farther direction to a nearer position.
/// Threads  values; any.
/// Source   Brown, Decentering distortion of lenses, 1966; the letters are OpenCV's.
#pragma once

#include <glm/glm.hpp>

#include <optional>
#include <utility>

namespace frustumscreen::geometry {

struct Lens {
    double k1 = 0.0;
    double k2 = 0.0;

    [[nodiscard]] bool operator==(const Lens&) const = default;
    [[nodiscard]] bool is_plain() const { return k1 == 0.0 && k2 == 0.0; }
    /// Maps a direction of the ideal pinhole to that of the real one.
    [[nodiscard]] std::optional<glm::dvec2> distort(const glm::dvec2& ideal) const;
    /// The inverse, to rounding; nullopt if no ideal direction before the fold maps there.
    [[nodiscard]] std::optional<glm::dvec2> undistort(const glm::dvec2& real) const;
    /// r^2 of the ideal direction at the fold: the smallest positive root of d(r (1 + k1 r^2 + k2 r^4)) / dr;
    /// infinite if the lens does not fold.
    [[nodiscard]] double fold_r2() const;
    /// Smallest and largest factor of ideal directions whose r^2 is at most `r2`.
    [[nodiscard]] std::pair<double, double> factors_within(double r2) const;
    /// Magnification of the real picture over the ideal one, by area: the determinant of `distort`.
    [[nodiscard]] double area_factor(double r2) const;
};

/// The factor of the distortion; also for types that carry derivatives.
template <typename T> [[nodiscard]] T radial_factor(const T& r2, const T& k1, const T& k2) {
    return T(1.0) + r2 * (k1 + k2 * r2);
}

} // namespace frustumscreen::geometry
