/// Textbook rotations in long double, as a reference.
#pragma once

#include "app/geometry/transform.h"

#include <array>
#include <cmath>

namespace frustumscreen::exact_pose {

using Real = long double;
using Vector = std::array<Real, 3>;
using Quaternion = std::array<Real, 4>; ///< w x y z

inline Quaternion about(const Vector& axis, Real angle) {
    const Real s = std::sin(angle / 2);
    return {std::cos(angle / 2), s * axis[0], s * axis[1], s * axis[2]};
}

/// Weights sin((1 - s) O) / sin O and sin(s O) / sin O, where O is the angle between the rotations along the
/// shorter way.
inline Quaternion slerp(const Quaternion& a, Quaternion b, Real share) {
    Real cosine = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        cosine += a[k] * b[k];
    }
    if (cosine < 0) {
        cosine = -cosine;
        for (Real& part : b) {
            part = -part;
        }
    }
    const Real angle = std::acos(cosine);
    Quaternion result{};
    for (std::size_t k = 0; k < 4; ++k) {
        result[k] = (std::sin((1 - share) * angle) * a[k] + std::sin(share * angle) * b[k]) / std::sin(angle);
    }
    return result;
}

inline glm::dquat rounded(const Quaternion& q) {
    return {static_cast<double>(q[0]), static_cast<double>(q[1]), static_cast<double>(q[2]),
            static_cast<double>(q[3])};
}

/// The angle between the rotations in radians, independent of the signs; exact for small angles too.
inline double angle(const glm::dquat& a, const Quaternion& b) {
    const std::array<Real, 4> q{a.w, a.x, a.y, a.z};
    Real less = 0;
    Real more = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        less += (q[k] - b[k]) * (q[k] - b[k]);
        more += (q[k] + b[k]) * (q[k] + b[k]);
    }
    return static_cast<double>(4 * std::asin(std::fmin(Real(1), std::sqrt(std::fmin(less, more)) / 2)));
}

} // namespace frustumscreen::exact_pose
