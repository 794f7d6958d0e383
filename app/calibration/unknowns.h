/// The 19 unknowns of a calibration by touch, as small changes of a model. The solver changes them, and
/// covariances refer to them.
///
/// They are scaled to magnitudes near 1: shares of the focal length and of the picture's width, radians,
/// metres. Rotations are about the touches' middle, so the arithmetic does not depend on the tracker's
/// origin.
/// Numbers  templates over T: double, or numbers that carry derivatives (ceres::Jet).
/// Threads  values; any.
#pragma once

#include "app/calibration/touch.h"
#include "app/calibration/touch_model.h"

#include <Eigen/Core>

namespace frustumscreen::calibration {

enum Unknown {
    focal_log,  ///< of sqrt(fx fy)
    aspect_log, ///< of fx / fy
    centre_u,   ///< cx off the picture's middle, in widths
    centre_v,   ///< cy off the picture's middle, in widths
    lens_k1,
    lens_k2,
    turn_x,
    turn_y,
    turn_z, ///< of the projector, in J
    shift_x,
    shift_y,
    shift_z, ///< of the touches' middle, in J
    offset_x,
    offset_y,
    offset_z, ///< of the touched place, in the sensor's frame
    tilt_a,
    tilt_b, ///< of the table, about two axes in it
    table_height,
    boards_share, ///< relative excess of the boards' true height
    unknown_count
};

using Changes = Eigen::Matrix<double, unknown_count, 1>;
using Covariance = Eigen::Matrix<double, unknown_count, unknown_count>;

/// A changed model, ready to predict what a touch reports.
template <typename T> struct ChangedModel {
    using Vector = Eigen::Matrix<T, 3, 1>;
    using Matrix = Eigen::Matrix<T, 3, 3>;

    /// `base`: a model; `middle`: the touches' middle in K; `change`: unknown_count numbers.
    ChangedModel(const TouchModel& base, const glm::dvec3& middle, const T* change);

    [[nodiscard]] Vector touched(const Touch& touch) const;
    /// Pixel and height of a point in K. The depth is kept positive, so that a start behind the projector has
    /// a value.
    [[nodiscard]] Vector pixel_and_height(const Vector& tracker_point) const;

    T fx, fy, cx, cy, k1, k2;
    Matrix turn; ///< J from K
    Vector middle_in_j;
    Vector offset;
    Vector up;
    T middle_height;
    T boards;
    Eigen::Vector3d middle;
};

[[nodiscard]] inline Eigen::Vector3d eigen(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}
[[nodiscard]] inline Eigen::Matrix3d eigen(const glm::dquat& q) {
    const glm::dmat3 m = glm::mat3_cast(q);
    Eigen::Matrix3d out;
    out << m[0][0], m[1][0], m[2][0], m[0][1], m[1][1], m[2][1], m[0][2], m[1][2], m[2][2];
    return out;
}
[[nodiscard]] inline glm::dvec3 glm_vector(const Eigen::Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

/// The rotation by a vector, exact to second order, made orthogonal by Cayley's formula: smooth at zero,
/// where derivatives are taken.
template <typename T> Eigen::Matrix<T, 3, 3> small_rotation(const T& x, const T& y, const T& z) {
    // The quaternion (1, v / 2), normalised.
    const T a = x * 0.5;
    const T b = y * 0.5;
    const T c = z * 0.5;
    const T s = T(2.0) / (T(1.0) + a * a + b * b + c * c);
    Eigen::Matrix<T, 3, 3> r;
    r << T(1.0) - s * (b * b + c * c), s * (a * b - c), s * (a * c + b), //
        s * (a * b + c), T(1.0) - s * (a * a + c * c), s * (b * c - a),  //
        s * (a * c - b), s * (b * c + a), T(1.0) - s * (a * a + b * b);
    return r;
}

/// Two orthogonal unit axes in the table's plane.
[[nodiscard]] Eigen::Matrix<double, 3, 2> table_axes(const glm::dvec3& up);

template <typename T>
ChangedModel<T>::ChangedModel(const TouchModel& base, const glm::dvec3& about, const T* change)
    : middle(eigen(about)) {
    using std::exp;
    const geometry::Pinhole& p = base.pinhole;
    const T focal = exp(change[focal_log]) * std::sqrt(p.fx * p.fy);
    const T aspect = exp(T(change[aspect_log] * 0.5)) * std::sqrt(p.fx / p.fy);
    fx = focal * aspect;
    fy = focal / aspect;
    cx = change[centre_u] * static_cast<double>(p.width) + p.cx;
    cy = change[centre_v] * static_cast<double>(p.width) + p.cy;
    k1 = change[lens_k1] + base.pinhole.lens.k1;
    k2 = change[lens_k2] + base.pinhole.lens.k2;
    turn = small_rotation(change[turn_x], change[turn_y], change[turn_z]) *
           eigen(base.projector_from_tracker.rotation).cast<T>();
    middle_in_j = eigen(base.projector_from_tracker.point(about)).cast<T>() +
                  Vector(change[shift_x], change[shift_y], change[shift_z]);
    offset =
        eigen(base.sensor_offset_m).cast<T>() + Vector(change[offset_x], change[offset_y], change[offset_z]);
    const Eigen::Matrix<double, 3, 2> axes = table_axes(base.table_up);
    up = eigen(base.table_up).cast<T>() + axes.col(0).cast<T>() * change[tilt_a] +
         axes.col(1).cast<T>() * change[tilt_b];
    up /= up.norm();
    middle_height = change[table_height] + base.height(about);
    boards = change[boards_share] + base.boards;
}

template <typename T> auto ChangedModel<T>::touched(const Touch& touch) const -> Vector {
    return eigen(touch.tracker_from_sensor.translation).cast<T>() +
           eigen(touch.tracker_from_sensor.rotation).cast<T>() * offset;
}

template <typename T> auto ChangedModel<T>::pixel_and_height(const Vector& tracker_point) const -> Vector {
    const Vector from_middle = tracker_point - middle.cast<T>();
    const Vector in_j = turn * from_middle + middle_in_j;
    const T depth = in_j.z() > T(1e-3) ? in_j.z() : T(1e-3);
    const T x = in_j.x() / depth;
    const T y = in_j.y() / depth;
    const T factor = geometry::radial_factor(T(x * x + y * y), k1, k2);
    return Vector(fx * x * factor + cx, fy * y * factor + cy, up.dot(from_middle) + middle_height);
}

/// The model with the changes applied.
[[nodiscard]] TouchModel changed(const TouchModel& base, const glm::dvec3& middle, const Changes& change);

} // namespace frustumscreen::calibration
