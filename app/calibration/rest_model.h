/// What rests determine: all that touches do, and how the prop is turned in the sensor. As unknowns these are three more.
///
/// The touched place is the middle of the prop's bottom.
/// Frames   as touch_model.h and unknowns.h have them.
/// Threads  values; any.
#pragma once

#include "app/calibration/rest.h"
#include "app/calibration/unknowns.h"

namespace frustumscreen {

struct RestModel {
    TouchModel touch;
    glm::dquat sensor_from_prop{1.0, 0.0, 0.0, 0.0};

    [[nodiscard]] RigidTransform prop_in_sensor() const { return {sensor_from_prop, touch.sensor_offset_m}; }
};

/// After the touches' unknowns: the prop's turn, in the sensor's frame.
enum RestUnknown { prop_turn_x = unknown_count, prop_turn_y, prop_turn_z, rest_unknown_count };

using RestChanges = Eigen::Matrix<double, rest_unknown_count, 1>;
using RestCovariance = Eigen::Matrix<double, rest_unknown_count, rest_unknown_count>;

/// A model with changes, ready to predict where points of the prop are.
template <typename T> struct ChangedRestModel {
    using Vector = Eigen::Matrix<T, 3, 1>;

    ChangedRestModel(const RestModel& base, const glm::dvec3& middle, const T* change)
        : touch(base.touch, middle, change),
          turn(small_rotation(change[prop_turn_x], change[prop_turn_y], change[prop_turn_z]) *
               eigen(base.sensor_from_prop).cast<T>()) {}

    /// From the sensor to a point of the prop, along K's axes.
    [[nodiscard]] Vector arm(const Eigen::Matrix3d& tracker_from_sensor,
                             const Eigen::Vector3d& prop_point) const {
        return tracker_from_sensor.cast<T>() * (touch.offset + turn * prop_point.cast<T>());
    }

    ChangedModel<T> touch;
    Eigen::Matrix<T, 3, 3> turn; ///< sensor from prop
};

[[nodiscard]] RestModel changed(const RestModel& base, const glm::dvec3& middle, const RestChanges& change);

} // namespace frustumscreen
