/// The model that rests determine: that of touches, the prop's rotation in the sensor, and the print's scale.
/// Four more unknowns.
///
/// The touched place is the middle of the prop's bottom.
/// Frames   as touch_model.h and unknowns.h have them.
/// Threads  values; any.
#pragma once

#include "app/calibration/rest.h"
#include "app/calibration/unknowns.h"

#include <cmath>

namespace frustumscreen::calibration {

struct RestModel {
    TouchModel touch;
    glm::dquat sensor_from_prop{1.0, 0.0, 0.0, 0.0};
    double print = 1.0; ///< scale of the printed sheet, about the prop's axis

    /// The true place of a printed point.
    [[nodiscard]] glm::dvec3 printed(const glm::dvec3& prop_point) const {
        return {print * prop_point.x, print * prop_point.y, prop_point.z};
    }

    [[nodiscard]] geometry::RigidTransform prop_in_sensor() const {
        return {sensor_from_prop, touch.sensor_offset_m};
    }
};

/// Unknowns in addition to those of touches.
enum RestUnknown {
    prop_turn_x = unknown_count, ///< of the prop, in the sensor's frame
    prop_turn_y,
    prop_turn_z,
    print_log, ///< of the print's size
    rest_unknown_count
};

using RestChanges = Eigen::Matrix<double, rest_unknown_count, 1>;
using RestCovariance = Eigen::Matrix<double, rest_unknown_count, rest_unknown_count>;

/// A changed model, ready to predict where points of the prop are.
template <typename T> struct ChangedRestModel {
    using Vector = Eigen::Matrix<T, 3, 1>;

    ChangedRestModel(const RestModel& base, const glm::dvec3& middle, const T* change)
        : touch(base.touch, middle, change),
          turn(small_rotation(change[prop_turn_x], change[prop_turn_y], change[prop_turn_z]) *
               eigen(base.sensor_from_prop).cast<T>()) {
        using std::exp; // finds a Jet's own by argument lookup
        print = exp(change[print_log]) * base.print;
    }

    /// From the sensor to a point of the prop, along K's axes.
    [[nodiscard]] Vector arm(const Eigen::Matrix3d& tracker_from_sensor, const Vector& prop_point) const {
        return tracker_from_sensor.cast<T>() * (touch.offset + turn * prop_point);
    }
    [[nodiscard]] Vector printed(const glm::dvec3& prop_point) const {
        return {print * prop_point.x, print * prop_point.y, T(prop_point.z)};
    }

    ChangedModel<T> touch;
    Eigen::Matrix<T, 3, 3> turn; ///< sensor from prop
    T print;
};

[[nodiscard]] RestModel changed(const RestModel& base, const glm::dvec3& middle, const RestChanges& change);

} // namespace frustumscreen::calibration
