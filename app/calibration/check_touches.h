/// Refuses touches that cannot determine a calibration before anything is computed: too few, all in one plane
/// or line, wrong units, mirrored.
///
/// Method   Affine fits of heights and of pixels to the sensor's place. A projector is not affine, so the
///          fits and their limits are rough; finer checks follow the fit (determinacy.h).
/// Threads  pure; any.
#pragma once

#include "app/calibration/touch.h"
#include "app/calibration/verdict.h"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace frustumscreen::calibration {

inline constexpr std::size_t min_touches = 6;
inline constexpr std::size_t min_touch_up = 3; ///< of a table that has been calibrated
/// Heights that differ by less count as one.
inline constexpr double min_height_m = 0.02;

/// The reason why these touches are refused, one sentence for a technician; nothing if they are accepted.
/// Quaternions are as reported, of any length.
[[nodiscard]] std::optional<VerdictReason> refusal_of(std::span<const Touch> touches, int width, int height);

/// Checks that touches share with rests. `name`: the name of the measurement at an index; `places`: the noun
/// for all of them, in a technician's words.
using PlaceName = std::function<std::string(std::size_t)>;
[[nodiscard]] std::optional<VerdictReason>
refusal_of_values(std::span<const Touch> touches, const glm::dvec2& picture, const PlaceName& name);
[[nodiscard]] std::optional<VerdictReason> refusal_of_spread(std::span<const Touch> touches, double width,
                                                             std::string_view places);
/// Checks by affine fits whether places, pixels and heights are consistent.
[[nodiscard]] std::optional<VerdictReason> refusal_of_directions(std::span<const Touch> touches,
                                                                 std::string_view places);
/// The check for touches on a calibrated table: they need no second height, and are compared with the table
/// later.
[[nodiscard]] std::optional<VerdictReason> refusal_of_few(std::span<const Touch> touches, int width,
                                                          int height);

} // namespace frustumscreen::calibration
