/// Draws a safe page, some rows at a time, so the whole picture need not be in memory.
///
/// Shape    rows from the picture's top; one byte per pixel.
/// Colour   greys as sRGB codes on black; a pixel's light is proportional to its coverage by a letter.
/// Threads  pure; any.
#pragma once

#include "app/safe/safe_page.h"

#include <cstdint>
#include <span>

namespace frustumscreen::safe {

/// Draws the rows from `first_row` that fit `greys`, whose size is a multiple of the page's width.
void draw_safe_rows(const SafePage& page, int first_row, std::span<std::uint8_t> greys);

} // namespace frustumscreen::safe
