/// Measures the eyes' place in the head's sensor on the table itself, with the projector, the tracker's
/// sensors of prop and head, and two buttons.
///
/// Errors   the settings lack something that it needs, the screen fails, or it ends without an eye.
/// Threads  the main one.
#pragma once

#include "app/calibration/eye_fit.h"
#include "app/calibration/procedure/sight_plan.h"
#include "app/programs/calibrate/calibrate_request.h"
#include "app/programs/calibrate/calibration_way.h"
#include "app/programs/calibrate/table_devices.h"

#include <optional>
#include <span>

namespace frustumscreen::programs {

[[nodiscard]] calibration::SightScene sight_scene(const settings::Settings& settings);

/// The fit on the settings' table. Nothing if the light of a cross does not reach the table.
[[nodiscard]] std::optional<calibration::EyeFit>
fit_reported(std::span<const calibration::ReportedSight> sights, const settings::Settings& settings);

/// Runs the procedure and keeps its result; nothing if it ended without an eye.
[[nodiscard]] Result<std::optional<WayEnd>>
measure_eyes(const settings::Settings& settings, const CalibrateRequest& request, TableDevices& devices);
/// Runs the procedure alone; an end without an eye is an error.
[[nodiscard]] Result<void> calibrate_eyes(const settings::Settings& settings,
                                          const CalibrateRequest& request);

} // namespace frustumscreen::programs
