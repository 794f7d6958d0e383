/// Draws a safe page, some rows at a time, so that no whole picture must be in memory.
///
/// Shape    rows from the picture's top; one byte a pixel.
/// Colour   greys as sRGB codes on black; what a letter covers of a pixel is its share of light.
/// Threads  pure; any.
#pragma once

#include "app/safe/safe_page.h"

#include <cstdint>
#include <span>

namespace frustumscreen {

/// Rows `first_row` and following, as many as fit `greys`, whose size is a multiple of the page's width.
void draw_safe_rows(const SafePage& page, int first_row, std::span<std::uint8_t> greys);

} // namespace frustumscreen
