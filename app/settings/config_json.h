/// The resolved, checked settings as JSON, for `frustumscreen config --json`.
///
/// Units    as in the settings: metres, degrees, pixels; matrices are 16 numbers, column-major.
/// Threads  pure; any.
#pragma once

#include "app/settings/settings.h"

#include <string>

namespace frustumscreen::settings {

/// projector {width, height, fx, fy, cx, cy, table_from_projector[16]}, prop {kind, base_m, top_m, height_m,
/// zone, faces[] {name, normal[3], corners[][3]}} in the prop's frame, eye_default_m[3], eye_zone, table,
/// lit_zone {any_eye, default_eye} and the rest. Ends with a line break.
[[nodiscard]] std::string config_json(const CheckedSettings& settings);

} // namespace frustumscreen::settings
