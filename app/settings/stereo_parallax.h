/// The parallax of stereo: how much less the two eyes converge on a point of the artifact than on the place of the prop
/// that shows it. The eyes focus on that place; where they converge far behind it, they tire.
///
/// Frame    prop P.
/// Units    metres, radians.
/// Method   a point straight ahead at distance r makes two eyes b apart converge by 2 atan(b / 2r). Rays through the whole prop,
///          from eyes all around: each enters at the place that shows it, and leaves at the farthest point that an
///          artifact can have. Sampled; it finds the largest parallax within 3 %.
/// Threads  pure; any. A parallax takes some tens of milliseconds.
#pragma once

#include "app/settings/settings.h"

#include <optional>

namespace frustumscreen::settings {

/// The largest parallax that people look at in comfort: one degree of arc. Source: Lambooij, IJsselsteijn, Fortuin and
/// Heynderickx 2009, Visual discomfort and visual fatigue of stereoscopic displays: a review, Journal of Imaging
/// Science and Technology 53(3).
inline constexpr double comfortable_parallax_rad = 0.017453292519943295;

/// The parallax of an artifact that fills the prop, for eyes `distance_m` from the middle of its foot, at any elevation that the
/// settings allow; in the hand, all around. 0 if no such eye is outside the prop.
[[nodiscard]] double largest_parallax_rad(const Settings& settings, double distance_m);

/// The distance from which on the parallax is comfortable; nothing if it is not even at `eye.farthest_m`.
[[nodiscard]] std::optional<double> comfortable_distance_m(const Settings& settings);

} // namespace frustumscreen::settings
