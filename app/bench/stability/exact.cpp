#include "app/bench/stability/exact.h"

#include <cmath>

namespace frustumscreen::bench::exact {

Vector of(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}
Vector operator+(const Vector& a, const Vector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vector operator-(const Vector& a, const Vector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vector operator*(Real s, const Vector& a) {
    return {s * a.x, s * a.y, s * a.z};
}
Real dot(const Vector& a, const Vector& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Real length(const Vector& a) {
    return std::sqrt(dot(a, a));
}

Rigid::Rigid(const geometry::RigidTransform& transform) : translation_(of(transform.translation)) {
    const glm::dquat& q = transform.rotation;
    Real w = q.w, x = q.x, y = q.y, z = q.z;
    const Real norm = std::sqrt(w * w + x * x + y * y + z * z);
    w /= norm;
    x /= norm;
    y /= norm;
    z /= norm;
    rows_ = {Vector{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
             Vector{2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
             Vector{2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
}

Vector Rigid::point(const Vector& p) const {
    return Vector{dot(rows_[0], p), dot(rows_[1], p), dot(rows_[2], p)} + translation_;
}

Vector Rigid::inverse_point(const Vector& p) const {
    const Vector d = p - translation_;
    return d.x * rows_[0] + d.y * rows_[1] + d.z * rows_[2];
}

Vector SetUp::eye_in_prop() const {
    return Rigid(table_from_prop).inverse_point(of(eye_m));
}

Vector SetUp::lens_in_prop() const {
    return Rigid(table_from_prop).inverse_point(of(table_from_projector.translation));
}

namespace {

Vector normal_of(const geometry::PropFace& face) {
    const Vector a = of(face.corners[0]);
    const Vector n = cross(of(face.corners[1]) - a, of(face.corners[2]) - a);
    return (1 / length(n)) * n;
}

} // namespace

Real SetUp::height(const geometry::PropFace& face, const Vector& point) const {
    return dot(normal_of(face), point - of(face.corners[0]));
}

std::optional<Seen> SetUp::see(const geometry::PropFace& face, const Vector& x) const {
    const Vector eye = eye_in_prop();
    const Real eye_height = height(face, eye);
    const Real fall = eye_height - height(face, x);
    if (!(eye_height > 0) || !(fall > 0)) {
        return std::nullopt;
    }
    Seen seen;
    seen.on_plane = eye + (eye_height / fall) * (x - eye);
    const Vector n = normal_of(face);
    seen.on_face = true;
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
        const Vector a = of(face.corners[k]);
        const Vector edge = of(face.corners[(k + 1) % face.corners.size()]) - a;
        seen.on_face = seen.on_face && dot(cross(edge, seen.on_plane - a), n) > 0;
    }
    const Vector lens = lens_in_prop();
    seen.sine_of_lens = height(face, lens) / length(lens - seen.on_plane);
    const Vector q = Rigid(table_from_projector).inverse_point(Rigid(table_from_prop).point(seen.on_plane));
    if (q.z > 0) {
        seen.u = projector.fx * q.x / q.z + projector.cx;
        seen.v = projector.fy * q.y / q.z + projector.cy;
        seen.in_picture =
            seen.u >= 0 && seen.v >= 0 && seen.u <= projector.width && seen.v <= projector.height;
    }
    return seen;
}

} // namespace frustumscreen::bench::exact
