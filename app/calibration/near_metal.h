/// Finds out whether metal near one place bends what an electromagnetic tracker reports.
///
/// Method   Metal answers the source's field as a small dipole. Four unknowns: its place and its strength. The tracker's error
///          that follows is computed to first order. Places on a grid about the touches are tried, and the
///          best is refined.
/// Limits   The source must be the origin of the tracker's frame. Metal that is far away bends all touches smoothly:
///          the fit absorbs that.
/// Source   Raab, Blood, Steiner and Jones, Magnetic position and orientation tracking system, 1979
/// Threads  pure; any.
#pragma once

#include "app/calibration/extra_unknowns.h"
#include "app/calibration/rigid_move.h"

#include <optional>

namespace frustumscreen::calibration {

/// The error of a reported pose by metal of strength 1 m^3 at a place in K: a turn and a shift about the
/// sensor. A conducting sphere's strength is minus half the cube of its radius.
[[nodiscard]] RigidMove bend_by_metal(const glm::dvec3& sensor, const glm::dvec3& metal);

/// The metal that explains most; nothing if no place for it is far enough from all touches. `all`: the fit to these
/// touches.
[[nodiscard]] std::optional<Disturbance> near_metal(std::span<const Touch> touches, const FitSetup& setup,
                                                    const FittedTouches& all);

} // namespace frustumscreen::calibration
