/// Rests from which nothing can be computed, said before anything is: too few, bad numbers, wrong units, near to each other, mirrored.
///
/// Threads  pure; any.
#pragma once

#include "app/calibration/plane_view.h"
#include "app/calibration/rest.h"

#include <span>
#include <string>

namespace frustumscreen {

inline constexpr std::size_t least_rests = 5;
/// That stand on the table or on a block: they say where the table is.
inline constexpr std::size_t least_standing = 4;

/// Why these rests are refused, one sentence for a technician; nothing if they are not. Quaternions are as reported, of any length.
[[nodiscard]] std::optional<std::string> refusal_of(std::span<const Rest> rests, int width, int height);
/// The same of what the points' views tell, once these are known.
[[nodiscard]] std::optional<std::string> refusal_of(std::span<const Rest> rests,
                                                    std::span<const std::optional<PlaneView>> views);

} // namespace frustumscreen
