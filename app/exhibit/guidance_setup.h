/// The guidance set-up, from the settings.
///
/// Threads  pure; any.
#pragma once

#include "app/guidance/face_reader.h"
#include "app/settings/settings.h"

namespace frustumscreen::exhibit {

[[nodiscard]] guidance::GuidanceSetup guidance_setup(const settings::Settings& settings);

} // namespace frustumscreen::exhibit
