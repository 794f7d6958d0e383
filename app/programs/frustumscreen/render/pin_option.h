/// The windows that `frustumscreen render --pin` pins.
///
/// Frames   table T; metres.
/// Threads  pure; any.
/// Errors   a text that is not a place; more windows than there may be; an eye that is not above the table.
#pragma once

#include "app/programs/common/command_line.h"
#include "app/scene/pinned_view.h"
#include "app/settings/settings.h"
#include "firmware_host/base/result.h"

#include <string>
#include <vector>

namespace frustumscreen::programs {

/// "X,Y" or "X,Y,YAW_DEG".
[[nodiscard]] ArgumentCheck is_pin();

/// `pins`: texts that passed the check. Their size is that of the settings.
[[nodiscard]] Result<std::vector<scene::WindowPlace>> places_of(const std::vector<std::string>& pins,
                                                                const settings::WindowSettings& settings);

/// The corners of the windows, for a camera that shows them.
[[nodiscard]] std::vector<glm::dvec3> corners_of(const std::vector<scene::WindowPlace>& places);

} // namespace frustumscreen::programs
