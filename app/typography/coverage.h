/// Helpers for pictures of text: coverage 0..255, linear light, row 0 at the top.
///
/// Units    pixels.
/// Threads  pure; any. Never in a frame: it allocates.
/// Errors   none.
#pragma once

#include "app/image/image.h"
#include "app/pack/glyph_runs.h"

#include <cstdint>

namespace frustumscreen::typography {

/// The widest setting that fits a width in type sizes, otherwise the narrowest; null if there is none. `text`
/// may be null.
[[nodiscard]] const pack::GlyphSetting* fitting_setting(const pack::GlyphText* text, double width_em);

/// Draws `from`, scaled by `brightness`, over `onto`, keeping the lighter of both; it must lie inside.
void draw_lighter(const image::Image<std::uint8_t>& from, double brightness, int left, int top,
                  image::Image<std::uint8_t>& onto);

/// Cuts off everything right of `width_px`, or left of it for text that runs to the left, with a fade before
/// the cut.
[[nodiscard]] image::Image<std::uint8_t> cut_off(const image::Image<std::uint8_t>& line, int width_px,
                                                 int fade_px, bool to_the_left);

} // namespace frustumscreen::typography
