/// Refuses rests that cannot determine a calibration before anything is computed: too few, bad numbers, wrong
/// units, too close together, mirrored.
///
/// Threads  pure; any.
#pragma once

#include "app/calibration/plane_view.h"
#include "app/calibration/rest.h"
#include "app/calibration/verdict.h"

#include <span>

namespace frustumscreen::calibration {

inline constexpr std::size_t min_rests = 5;
/// Rests on the table or on a block; they determine the table's plane.
inline constexpr std::size_t min_standing = 4;

/// The reason why these rests are refused, one sentence for a technician; nothing if they are accepted.
/// Quaternions are as reported, of any length.
[[nodiscard]] std::optional<VerdictReason> refusal_of(std::span<const Rest> rests, int width, int height);
/// The same check on the points' plane views.
[[nodiscard]] std::optional<VerdictReason> refusal_of(std::span<const Rest> rests,
                                                      std::span<const std::optional<PlaneView>> views);

} // namespace frustumscreen::calibration
