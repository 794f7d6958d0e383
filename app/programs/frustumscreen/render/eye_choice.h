/// The eyes whose pictures `frustumscreen render` draws.
///
/// Frames   table T; metres.
/// Threads  pure; any.
/// Errors   both eyes without a layout for them, or where a picture shows one eye alone.
#pragma once

#include "app/settings/settings.h"
#include "app/tracking/tracked_state.h"
#include "firmware_host/base/result.h"

#include <glm/glm.hpp>

#include <string_view>
#include <vector>

namespace frustumscreen::programs {

/// Middle: the point between the eyes. Both: in the configured layout.
enum class EyeChoice { Middle, Left, Right, Both };

/// `eye`: "left", "right", "both", or empty for what the settings show. `one_eye`: the output shows one eye alone.
[[nodiscard]] Result<EyeChoice> choose_eye(std::string_view eye, settings::Stereo stereo, bool one_eye);

/// One eye, or for Both the left and the right one.
[[nodiscard]] std::vector<glm::dvec3> chosen_eyes(EyeChoice choice, const tracking::TrackedState& state,
                                                  double interocular_m);

} // namespace frustumscreen::programs
