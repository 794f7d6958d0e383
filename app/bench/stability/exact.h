/// Computes the picture in the ordinary way, in long double: transforms as its own matrices, a ray from the
/// eye, a plane, a pinhole. Shares no arithmetic with app/geometry.
///
/// Frames   table T and prop P as named; metres, pixels.
/// Threads  pure; any.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/prop_shape.h"
#include "app/geometry/transform.h"

#include <array>
#include <optional>

namespace frustumscreen::bench::exact {

using Real = long double;

struct Vector {
    Real x = 0, y = 0, z = 0;
};
[[nodiscard]] Vector of(const glm::dvec3& v);
[[nodiscard]] Vector operator+(const Vector& a, const Vector& b);
[[nodiscard]] Vector operator-(const Vector& a, const Vector& b);
[[nodiscard]] Vector operator*(Real s, const Vector& a);
[[nodiscard]] Real dot(const Vector& a, const Vector& b);
[[nodiscard]] Vector cross(const Vector& a, const Vector& b);
[[nodiscard]] Real length(const Vector& a);

/// A rigid transform as rows and a translation; quaternions of any length are normalised here.
class Rigid {
public:
    explicit Rigid(const geometry::RigidTransform& transform);
    [[nodiscard]] Vector point(const Vector& p) const;
    [[nodiscard]] Vector inverse_point(const Vector& p) const;

private:
    std::array<Vector, 3> rows_{};
    Vector translation_;
};

/// How a point X is seen on the plane of a face.
struct Seen {
    Real u = 0, v = 0;       ///< pixels
    Vector on_plane;         ///< where the eye's ray meets the plane, prop frame
    Real sine_of_lens = 0;   ///< elevation of the lens above the plane, seen from that point
    bool on_face = false;    ///< inside the face's outline
    bool in_picture = false; ///< in front of the lens and within the picture
};

/// A prop, an eye and a projector.
struct SetUp {
    geometry::PropShape prop;
    geometry::Pinhole projector;
    geometry::RigidTransform table_from_projector;
    geometry::RigidTransform table_from_prop;
    glm::dvec3 eye_m{0.0}; ///< table frame

    [[nodiscard]] Vector eye_in_prop() const;
    [[nodiscard]] Vector lens_in_prop() const;
    /// Height of a point above the plane through a face's first three corners.
    [[nodiscard]] Real height(const geometry::PropFace& face, const Vector& point) const;
    /// nullopt if the ray from the eye through `x` (prop frame) does not meet the face's plane from above.
    [[nodiscard]] std::optional<Seen> see(const geometry::PropFace& face, const Vector& x) const;
};

} // namespace frustumscreen::bench::exact
