/// The eyes' place in the head's sensor, measured on the table itself, with the projector, the tracker's sensors of prop and head, and two buttons.
///
/// Errors   settings without what it needs, a screen that fails, an end without an eye.
/// Threads  the main one.
#pragma once

#include "app/calibration/eye_fit.h"
#include "app/calibration/procedure/sight_plan.h"
#include "app/programs/calibrate/calibrate_request.h"
#include "app/programs/calibrate/calibration_way.h"
#include "app/programs/calibrate/table_devices.h"

#include <optional>
#include <span>

namespace frustumscreen {

[[nodiscard]] SightScene sight_scene(const Settings& settings);

/// On the settings' table. Nothing: the light of a cross does not come down on it.
[[nodiscard]] std::optional<EyeFit> fit_reported(std::span<const ReportedSight> sights,
                                                 const Settings& settings);

/// From the first word on the table to the kept file; nothing: it ended without an eye.
[[nodiscard]] Result<std::optional<WayEnd>>
measure_eyes(const Settings& settings, const CalibrateRequest& request, TableDevices& devices);
/// The same alone, where an end without an eye is an error.
[[nodiscard]] Result<void> calibrate_eyes(const Settings& settings, const CalibrateRequest& request);

} // namespace frustumscreen
