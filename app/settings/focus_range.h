/// The depths at which the projector's picture is sharp, and those at which the prop is lit.
///
/// Focused at f, a lens with an opening of A blurs a point into a circle of A |d - f| / f at the distance d. A pixel is
/// d / fx wide there, so the blur is A fx |1 / f - 1 / d| pixels: the sharp depths are those at which it is below one.
///
/// Frames   depths along the optical axis, metres in front of the lens.
/// Threads  pure; any.
#pragma once

#include "app/settings/settings.h"

#include <optional>

namespace frustumscreen::settings {

struct DepthRange {
    double nearest_m = 0.0;
    double farthest_m = 0.0; ///< may be infinite
    [[nodiscard]] double middle_m() const { return 0.5 * (nearest_m + farthest_m); }
    [[nodiscard]] double length_m() const { return farthest_m - nearest_m; }
};

/// Width of the blur at `depth_m` with the focus at `focus_m`, in pixels there.
[[nodiscard]] double blur_px(const ProjectorSettings& projector, double focus_m, double depth_m);

/// Where the blur is below a pixel.
[[nodiscard]] DepthRange sharp_depths(const ProjectorSettings& projector, double focus_m);

/// The widest opening of the lens with which all of `range` is sharp, focused at its middle.
[[nodiscard]] double largest_aperture_mm(const ProjectorSettings& projector, const DepthRange& range);

/// The depths of what is lit while the prop is in its zone: on the table from the table to the prop's height; in the hand
/// from the table up to where the whole prop still fits into the picture at every turn. None: it fits nowhere.
[[nodiscard]] std::optional<DepthRange> lit_depths(const Settings& settings);

} // namespace frustumscreen::settings
