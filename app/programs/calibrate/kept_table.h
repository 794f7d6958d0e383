/// A calibrated table as the exhibit keeps it: in the frame of its settings, with the prop's place in its
/// sensor.
///
/// Frames   The calibration's table frame has its origin where the light of the picture's middle falls on the
///          table, and +X along the picture's u. The exhibit's frame is turned and shifted so that the middle
///          and u agree with the settings. The front thus stays the front, however the projector hangs.
/// Prop     For touches: the prop's bottom's centre is the touched place, and the prop is upright in most
///          touches. Touches do not determine its rotation about its axis in its sensor; that stays as in the
///          settings.
/// Threads  pure; any.
#pragma once

#include "app/calibration/calibrated_table.h"
#include "app/calibration/touch.h"
#include "app/settings/settings.h"

#include <span>

namespace frustumscreen {

/// The settings' projector must look down at the table; checked settings do.
[[nodiscard]] RigidTransform settings_from_measured(const ProjectorSettings& projector);

/// The prop in its sensor: its bottom's centre at the touched place, its axis as in most touches.
[[nodiscard]] RigidTransform sensor_from_prop(const CalibratedTable& table, std::span<const Touch> touches,
                                              const RigidTransform& described);

/// Pinhole, poses and registration, for a known pose of the prop in its sensor.
[[nodiscard]] Calibration kept_table(const CalibratedTable& table, const RigidTransform& sensor_from_prop,
                                     const Settings& settings);

/// Pinhole, poses and registration; the caller adds the origin and the quality.
[[nodiscard]] Calibration kept_table(const CalibratedTable& table, std::span<const Touch> touches,
                                     const Settings& settings);

} // namespace frustumscreen
