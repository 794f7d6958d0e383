#include "app/geometry/lens.h"

#include <cmath>
#include <limits>

namespace frustumscreen::geometry {

double Lens::fold_r2() const {
    // 1 + 3 k1 q + 5 k2 q^2 = 0, solved for 1/q, so that k2 = 0 is no special case.
    const double discriminant = 9.0 * k1 * k1 - 20.0 * k2;
    if (discriminant < 0.0) {
        return std::numeric_limits<double>::infinity();
    }
    const double inverse = 0.5 * (-3.0 * k1 + std::sqrt(discriminant));
    return inverse > 0.0 ? 1.0 / inverse : std::numeric_limits<double>::infinity();
}

std::optional<glm::dvec2> Lens::distort(const glm::dvec2& ideal) const {
    const double r2 = glm::dot(ideal, ideal);
    if (!(r2 < fold_r2())) {
        return std::nullopt;
    }
    return ideal * radial_factor(r2, k1, k2);
}

std::optional<glm::dvec2> Lens::undistort(const glm::dvec2& real) const {
    const double goal = glm::length(real);
    const double fold = std::sqrt(fold_r2());
    const auto bent = [this](double r) { return r * radial_factor(r * r, k1, k2); };
    if (!std::isfinite(goal) || (std::isfinite(fold) && !(goal < bent(fold)))) {
        return std::nullopt;
    }
    if (goal == 0.0) {
        return real;
    }
    // The function rises from 0 to the fold: Newton's steps stay in a bracket, which is halved when they
    // would leave it.
    double low = 0.0;
    double high = std::isfinite(fold) ? fold : goal;
    while (bent(high) < goal) {
        high *= 2.0;
    }
    double r = std::fmin(goal, high);
    for (int step = 0; step < 100; ++step) {
        const double off = bent(r) - goal;
        (off > 0.0 ? high : low) = r;
        double next = r - off / (1.0 + r * r * (3.0 * k1 + 5.0 * k2 * r * r));
        if (!(next > low && next < high)) {
            next = 0.5 * (low + high);
        }
        if (std::abs(next - r) <= 1e-16 * r) {
            break;
        }
        r = next;
    }
    return real * (r / goal);
}

std::pair<double, double> Lens::factors_within(double r2) const {
    const double far = radial_factor(r2, k1, k2);
    double least = std::fmin(1.0, far);
    double most = std::fmax(1.0, far);
    const double turning = k2 != 0.0 ? -0.5 * k1 / k2 : -1.0; // where d(factor) / d(r^2) is 0
    if (turning > 0.0 && turning < r2) {
        const double there = radial_factor(turning, k1, k2);
        least = std::fmin(least, there);
        most = std::fmax(most, there);
    }
    return {least, most};
}

double Lens::area_factor(double r2) const {
    return radial_factor(r2, k1, k2) * (1.0 + r2 * (3.0 * k1 + 5.0 * k2 * r2));
}

} // namespace frustumscreen::geometry
