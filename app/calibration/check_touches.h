/// Touches from which nothing can be computed, said before anything is: too few, in one plane or line, in wrong units, mirrored.
///
/// Method   affine fits: heights and pixels by the sensor's place. They are rough (a projector is not affine), and so are the limits; what is
///          finer is judged after the fit (determinacy.h).
/// Threads  pure; any.
#pragma once

#include "app/calibration/touch.h"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace frustumscreen {

inline constexpr std::size_t least_touches = 6;
inline constexpr std::size_t least_touch_up = 3; ///< of a table that was calibrated already
/// Below, heights count as one.
inline constexpr double least_height_m = 0.02;

/// Why these touches are refused, one sentence for a technician; nothing if they are not. Quaternions are as reported, of any length.
[[nodiscard]] std::optional<std::string> refusal_of(std::span<const Touch> touches, int width, int height);

/// What is asked of each of these, also of rests of the prop: `name` of the one at an index, `places` of all, in a technician's words.
using PlaceName = std::function<std::string(std::size_t)>;
[[nodiscard]] std::optional<std::string> refusal_of_values(std::span<const Touch> touches,
                                                           const glm::dvec2& picture, const PlaceName& name);
[[nodiscard]] std::optional<std::string> refusal_of_spread(std::span<const Touch> touches, double width,
                                                           std::string_view places);
/// Whether places, pixels and heights fit each other at all, by affine fits.
[[nodiscard]] std::optional<std::string> refusal_of_directions(std::span<const Touch> touches,
                                                               std::string_view places);
/// As that, of touches at a table that is known already: they need no two heights, and are held against it later.
[[nodiscard]] std::optional<std::string> refusal_of_few(std::span<const Touch> touches, int width,
                                                        int height);

} // namespace frustumscreen
