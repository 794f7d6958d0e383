/// Pictures by which a technician judges the projector: is it sharp everywhere, does it show every grey.
///
/// Threads  as Canvas.
#pragma once

#include "app/image/image.h"
#include "app/typography/text_image.h"

namespace frustumscreen {

/// White on black: nine stars whose spokes meet, and beside each of them lines of one, two and three pixels. The outermost pixels are
/// white. Where a star's middle is grey in a smaller circle, the picture is sharper.
[[nodiscard]] Image8 focus_picture(int width, int height);

inline constexpr int grey_steps = 16;
/// Columns from black to white in even steps of the codes, each with its code, and as many again for the four darkest and the four
/// brightest codes' neighbours: who sees no difference there has a projector, or an HDMI range, that cuts them off.
[[nodiscard]] Image8 grey_picture(int width, int height, const Typesetter& typesetter);

} // namespace frustumscreen
