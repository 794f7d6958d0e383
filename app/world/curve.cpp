#include "app/world/curve.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace frustumscreen::world {

namespace {

glm::dvec4 unit_or(const glm::dvec4& rotation, const glm::dvec4& otherwise) {
    const double length = glm::length(rotation);
    return length > 0.0 ? rotation / length : otherwise;
}

constexpr glm::dvec4 no_rotation{0.0, 0.0, 0.0, 1.0};

/// The value of a key as it counts: a rotation of unit length.
glm::dvec4 as_value(Path path, const glm::vec4& key) {
    return path == Path::Rotation ? unit_or(key, no_rotation) : glm::dvec4(key);
}

/// The arc's angle comes from two lengths: an arc cosine loses half the digits of a small angle.
glm::dvec4 spherical(const glm::dvec4& from, const glm::dvec4& to, double share) {
    const glm::dvec4 near = glm::dot(from, to) < 0.0 ? -to : to; // one rotation, and the shorter way
    const double angle = 2.0 * std::atan2(glm::length(from - near), glm::length(from + near));
    if (!(angle > 0.0)) {
        return from;
    }
    const double all = std::sin(angle);
    return unit_or((std::sin(angle * (1.0 - share)) / all) * from + (std::sin(angle * share) / all) * near,
                   from);
}

/// Between key `k` and the next; a tangent is for a second, so it is scaled by the interval.
glm::dvec4 cubic(const Curve& curve, Path path, std::size_t k, double interval_s, double share) {
    const double t = share;
    const double t2 = t * t;
    const double t3 = t2 * t;
    const glm::dvec4 from = as_value(path, curve.values[3 * k + 1]);
    const glm::dvec4 leaves(curve.values[3 * k + 2]);
    const glm::dvec4 comes(curve.values[3 * k + 3]);
    const glm::dvec4 to = as_value(path, curve.values[3 * k + 4]);
    const glm::dvec4 value = (2.0 * t3 - 3.0 * t2 + 1.0) * from + interval_s * (t3 - 2.0 * t2 + t) * leaves +
                             (3.0 * t2 - 2.0 * t3) * to + interval_s * (t3 - t2) * comes;
    return path == Path::Rotation ? unit_or(value, t < 0.5 ? from : to) : value;
}

} // namespace

glm::dvec4 blend(Path path, const glm::dvec4& from, const glm::dvec4& to, double share) {
    return path == Path::Rotation ? spherical(from, to, share) : from + share * (to - from);
}

glm::dvec4 value_at(const Curve& curve, Path path, double seconds) {
    const bool spline = curve.interpolation == Interpolation::CubicSpline;
    assert(!curve.times_s.empty() && curve.values.size() == (spline ? 3 : 1) * curve.times_s.size());
    const auto value = [&](std::size_t k) { return as_value(path, curve.values[spline ? 3 * k + 1 : k]); };
    const auto after = std::upper_bound(curve.times_s.begin(), curve.times_s.end(), seconds,
                                        [](double time, float key) { return time < key; });
    if (after == curve.times_s.begin() || std::isnan(seconds)) {
        return value(0);
    }
    const auto k = static_cast<std::size_t>(after - curve.times_s.begin()) - 1;
    if (after == curve.times_s.end() || curve.interpolation == Interpolation::Step) {
        return value(k);
    }
    const double begin = curve.times_s[k];
    const double interval_s = *after - begin; // above 0: `after` is the first key past `seconds`
    const double share = (seconds - begin) / interval_s;
    return spline ? cubic(curve, path, k, interval_s, share) : blend(path, value(k), value(k + 1), share);
}

} // namespace frustumscreen::world
