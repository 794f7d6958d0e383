/// Limits of a torch's content, for the writer and the reader.
///
/// Threads  pure; any.
#pragma once

#include "app/torch/content.h"

#include <optional>
#include <span>
#include <string>

namespace frustumscreen::pack::torch_limits {

inline constexpr double colour = 16.0; ///< linear light: a factor of the surface's own colour
inline constexpr double min_size = 0.001, max_size = 4.0;
inline constexpr double min_width = 0.0005, max_width = 1.0;
inline constexpr double magnification = 16.0; ///< from 1 on
inline constexpr double scroll_per_s = 10.0;
inline constexpr double turn_rad_per_s = 20.0;
/// Below three flashes a second, which can cause seizures (WCAG 2.3.1).
inline constexpr double pulse_hz = 2.5;
inline constexpr double min_height_per_width = 0.05, max_height_per_width = 20.0;
inline constexpr double min_rate_hz = 0.1, max_rate_hz = 60.0; ///< of a film

/// As a predicate: "has 4 stages; allowed are 1 to 3".
[[nodiscard]] std::optional<std::string> fault_of_stages(std::span<const torch::Stage> stages);

} // namespace frustumscreen::pack::torch_limits
