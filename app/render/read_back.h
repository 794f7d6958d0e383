/// Reads pictures back from the GPU. For tests and the offline renderer; never in the exhibit's frame.
///
/// Threads  the one whose context is current.
#pragma once

#include "app/image/image.h"

namespace frustumscreen::render {

/// Colour of a framebuffer as sRGB codes, alpha 255; row 0 at the picture's top.
[[nodiscard]] image::Image8 read_colour(unsigned framebuffer, int width, int height);
/// As above, into an image of the framebuffer's size.
void read_colour_into(unsigned framebuffer, image::Image8& image);

/// Waits until the GPU has completed all its commands. For measuring.
void wait_until_drawn();

} // namespace frustumscreen::render
