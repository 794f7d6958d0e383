/// The move of the projector, or of the tracker's source with all that it reports, since a table was
/// calibrated: six unknowns.
///
/// Frames   The move is in the tracker's frame K, about a place in it: of the source, or of the projector
///          relative to it.
/// Units    metres, radians.
/// Threads  pure; any.
#pragma once

#include "app/calibration/calibrated_table.h"
#include "app/calibration/unknowns.h"

#include <string_view>

namespace frustumscreen::calibration {

/// Either: both moves explain the touches and correct the picture alike.
enum class Moved { Nothing, Projector, Tracker, Either };
[[nodiscard]] std::string_view name_of(Moved moved);

/// A small turn, as a rotation vector in radians, then a shift in metres.
using RigidMove = Eigen::Matrix<double, 6, 1>;
using ByRigidMove = Eigen::Matrix<double, unknown_count, 6>;

/// Standard deviations of the prior: a bump, not a new set-up.
inline constexpr double usual_turn_rad = 0.026; // one degree and a half
inline constexpr double usual_shift_m = 0.03;
/// Turned and shifted about `middle`.
[[nodiscard]] geometry::RigidTransform rigid(const RigidMove& move, const glm::dvec3& middle);
/// Inverse variances of the prior.
[[nodiscard]] RigidMove usual_move_weights();
/// Error of the kept table itself, in addition to the touches' noise.
inline constexpr double kept_error_m = 6e-4;

[[nodiscard]] TouchModel model_of(const CalibratedTable& table);
/// `which`: the projector, or the tracker; the table moves with the tracker's source in its frame.
[[nodiscard]] TouchModel moved_model(const TouchModel& kept, Moved which, const RigidMove& move,
                                     const glm::dvec3& middle);
/// Derivatives of the model's unknowns by a move.
[[nodiscard]] ByRigidMove by_move(const TouchModel& model, Moved which);

} // namespace frustumscreen::calibration
