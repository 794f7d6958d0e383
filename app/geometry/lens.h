/// Radial distortion of a projector's or a camera's lens: x' = x (1 + k1 r^2 + k2 r^4), r^2 = |x|^2.
///
/// Frame    x is a direction's (X / Z, Y / Z) in the pinhole's frame; a pixel is fx x' + cx, fy y' + cy.
/// Errors   beyond the fold, where the lens would bring a farther direction to a nearer place, there is nothing.
/// Threads  values; any.
/// Source   Brown, Decentering distortion of lenses, 1966; the letters are OpenCV's.
#pragma once

#include <glm/glm.hpp>

#include <optional>
#include <utility>

namespace frustumscreen {

struct Lens {
    double k1 = 0.0;
    double k2 = 0.0;

    [[nodiscard]] bool operator==(const Lens&) const = default;
    [[nodiscard]] bool is_plain() const { return k1 == 0.0 && k2 == 0.0; }
    /// From a direction of the ideal pinhole to that of the real one.
    [[nodiscard]] std::optional<glm::dvec2> distort(const glm::dvec2& ideal) const;
    /// And back, to the last bits; nothing where no ideal direction before the fold comes there.
    [[nodiscard]] std::optional<glm::dvec2> undistort(const glm::dvec2& real) const;
    /// r^2 of the ideal direction at the fold: the least positive root of d(r (1 + k1 r^2 + k2 r^4)) / dr; infinite
    /// where the lens does not fold.
    [[nodiscard]] double fold_r2() const;
    /// Least and most factor of ideal directions whose r^2 is at most this.
    [[nodiscard]] std::pair<double, double> factors_within(double r2) const;
    /// How much larger the real picture is there than the ideal one, by area: the determinant of `distort`.
    [[nodiscard]] double area_factor(double r2) const;
};

/// The factor of the distortion; also for numbers that carry derivatives.
template <typename T> [[nodiscard]] T radial_factor(const T& r2, const T& k1, const T& k2) {
    return T(1.0) + r2 * (k1 + k2 * r2);
}

} // namespace frustumscreen
