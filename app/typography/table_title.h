/// An artifact's title on the table below its picture: at most two centred lines, in the smallest type.
///
/// Units    metres on the table. Coverage is linear light, 255 = white; row 0 at the top of the first line's
///          box.
/// Threads  as Typesetter; made once for each title and language.
/// Method   text beyond two lines is cut off, and the last letters before the cut fade out.
#pragma once

#include "app/pack/glyph_runs.h"
#include "app/typography/caption_image.h"
#include "app/typography/text_image.h"

#include <string>

namespace frustumscreen::typography {

/// Some millimetres more than a place's width: the bake breaks lines for this width, and there are gaps
/// between places.
inline constexpr double table_title_width_m = 0.0765;

/// A title that the bake has shaped, in any script.
[[nodiscard]] CaptionImage make_table_title(const pack::GlyphRuns& runs, const pack::DistanceAtlas& atlas,
                                            const pack::GlyphText& title, double texels_per_m);
[[nodiscard]] CaptionImage make_table_title(const Typesetter& typesetter, const std::string& title,
                                            double texels_per_m);

/// Placeholder for a missing picture in a place; coverage with `side_px` texels a side.
[[nodiscard]] image::Image<std::uint8_t> outlined_square(int side_px);
/// As above, with three dots: there are more artifacts.
[[nodiscard]] image::Image<std::uint8_t> more_mark(int side_px);

} // namespace frustumscreen::typography
