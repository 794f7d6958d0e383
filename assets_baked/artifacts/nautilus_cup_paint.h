/// The nautilus cup's texture, and the chasing of its gilded foot.
///
/// Frame    strips of rows: shell outside and inside (u from the coil to the lip, v once around the whorl),
///          foot and stem (u around, v upwards), straps and other gilded parts.
/// Threads  uses all cores; the result does not depend on their number.
#pragma once

#include "app/image/image.h"
#include "assets_baked/artifacts/atlas.h"

namespace frustumscreen::artifacts {

namespace cup_atlas {
inline constexpr int size = 2048;
inline constexpr AtlasStrip outside{0, 1024};
inline constexpr AtlasStrip inside{1032, 440};
inline constexpr AtlasStrip stem{1480, 400};
inline constexpr AtlasStrip straps{1888, 160};
} // namespace cup_atlas

/// Height of the chasing on foot and stem in mm: `angle` radians, `length` mm along the profile. 0 on plain
/// metal.
[[nodiscard]] double chasing_mm(double angle, double length);

/// `stem_length_mm` is the length of the profile whose chasing is painted.
[[nodiscard]] image::Image8 paint_nautilus_cup(double stem_length_mm);

} // namespace frustumscreen::artifacts
