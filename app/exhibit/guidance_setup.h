/// The inputs of guidance: its set-up from the settings, and each situation from the tracked state.
///
/// Threads  pure; any.
#pragma once

#include "app/guidance/face_reader.h"
#include "app/settings/settings.h"
#include "app/tracking/tracked_state.h"

namespace frustumscreen::exhibit {

[[nodiscard]] guidance::GuidanceSetup guidance_setup(const settings::Settings& settings);
/// The situation of the tracked state; with the two eyes that are shown, if the set-up has two.
[[nodiscard]] guidance::GuidedState guided_state(const guidance::GuidanceSetup& setup,
                                                 const tracking::TrackedState& tracked_state);

} // namespace frustumscreen::exhibit
