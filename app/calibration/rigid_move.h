/// What may have moved since a table was calibrated, as six unknowns: the projector, or the tracker's source with all that it reports.
///
/// Frames   the move is in the tracker's frame K, about a place in it: of the source, or as seen from it of the projector.
/// Units    metres, radians.
/// Threads  pure; any.
#pragma once

#include "app/calibration/calibrated_table.h"
#include "app/calibration/unknowns.h"

#include <string_view>

namespace frustumscreen {

/// Either: both explain the touches; for the picture on the prop it is the same.
enum class Moved { Nothing, Projector, Tracker, Either };
[[nodiscard]] std::string_view name_of(Moved moved);

/// Turn, then shift.
using RigidMove = Eigen::Matrix<double, 6, 1>;
using ByRigidMove = Eigen::Matrix<double, unknown_count, 6>;

/// Standard deviations before anything was touched: a bump, no new set-up.
inline constexpr double usual_turn_rad = 0.026; // one degree and a half
inline constexpr double usual_shift_m = 0.03;
/// One over their squares.
[[nodiscard]] RigidMove usual_move_weights();
/// The kept table is itself off by about this much: what touches tell of it beyond the touches' own noise.
inline constexpr double kept_error_m = 6e-4;

[[nodiscard]] TouchModel model_of(const CalibratedTable& table);
/// `which`: the projector, or the tracker, whose source takes the table along in its frame.
[[nodiscard]] TouchModel moved_model(const TouchModel& kept, Moved which, const RigidMove& move,
                                     const glm::dvec3& middle);
/// How the model's unknowns change with a move.
[[nodiscard]] ByRigidMove by_move(const TouchModel& model, Moved which);

} // namespace frustumscreen
