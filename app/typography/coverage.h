/// What pictures of text have in common: coverage 0..255, linear light, row 0 at the top.
///
/// Units    pixels.
/// Threads  pure; any. Never in the frame: it allocates.
/// Errors   none.
#pragma once

#include "app/image/image.h"
#include "app/pack/glyph_runs.h"

#include <cstdint>

namespace frustumscreen {

/// The widest setting that fits into a width in type sizes, else the narrowest; null without any. `text` may be null.
[[nodiscard]] const GlyphSetting* fitting_setting(const GlyphText* text, double width_em);

/// Draws `from`, scaled by `brightness`, over what is there, lighter over darker; it must lie inside.
void draw_lighter(const Image<std::uint8_t>& from, double brightness, int left, int top,
                  Image<std::uint8_t>& onto);

/// What is to the right of `width_px`, or to the left where the text runs there, is cut off; before that it fades out.
[[nodiscard]] Image<std::uint8_t> cut_off(const Image<std::uint8_t>& line, int width_px, int fade_px,
                                          bool to_the_left);

} // namespace frustumscreen
