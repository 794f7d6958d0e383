/// A calibrated table as the exhibit keeps it: in the frame of its settings, with the prop's place in its sensor.
///
/// Frames   the calibration's table frame has its origin where the light of the picture's middle meets the table, +X along the
///          picture's u. The exhibit's is turned and shifted so that the middle and u are where the settings have them: so that
///          the front stays the front, however the projector hangs.
/// Prop     of touches: it stands on its bottom's centre, the touched place, upright in most touches. How it is turned about its axis in its
///          sensor, touches do not tell: that stays as the settings have it.
/// Threads  pure; any.
#pragma once

#include "app/calibration/calibrated_table.h"
#include "app/calibration/touch.h"
#include "app/settings/settings.h"

#include <span>

namespace frustumscreen {

/// The settings' projector must look down at the table; checked ones do.
[[nodiscard]] RigidTransform settings_from_measured(const ProjectorSettings& projector);

/// The prop in its sensor: its bottom's centre at the touched place, its axis as it stood in most touches.
[[nodiscard]] RigidTransform sensor_from_prop(const CalibratedTable& table, std::span<const Touch> touches,
                                              const RigidTransform& described);

/// Pinhole, poses and registration, where it is known how the prop lies in its sensor.
[[nodiscard]] Calibration kept_table(const CalibratedTable& table, const RigidTransform& sensor_from_prop,
                                     const Settings& settings);

/// Pinhole, poses and registration; who made it and how well is left to the caller.
[[nodiscard]] Calibration kept_table(const CalibratedTable& table, std::span<const Touch> touches,
                                     const Settings& settings);

} // namespace frustumscreen
