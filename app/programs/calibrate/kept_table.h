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

namespace frustumscreen::programs {

/// The settings' projector must look down at the table; checked settings do.
[[nodiscard]] geometry::RigidTransform settings_from_measured(const settings::ProjectorSettings& projector);

/// The prop in its sensor: its bottom's centre at the touched place, its axis as in most touches.
[[nodiscard]] geometry::RigidTransform sensor_from_prop(const calibration::CalibratedTable& table,
                                                        std::span<const calibration::Touch> touches,
                                                        const geometry::RigidTransform& described);

/// Pinhole, poses and registration, for a known pose of the prop in its sensor.
[[nodiscard]] settings::Calibration kept_table(const calibration::CalibratedTable& table,
                                               const geometry::RigidTransform& sensor_from_prop,
                                               const settings::Settings& settings);

/// Pinhole, poses and registration; the caller adds the origin and the quality.
[[nodiscard]] settings::Calibration kept_table(const calibration::CalibratedTable& table,
                                               std::span<const calibration::Touch> touches,
                                               const settings::Settings& settings);

} // namespace frustumscreen::programs
