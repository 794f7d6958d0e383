/// Pictures for judging a projector: is it sharp everywhere, does it show every grey.
///
/// Threads  as Canvas.
#pragma once

#include "app/image/image.h"
#include "app/typography/text_image.h"

namespace frustumscreen::typography {

/// White on black: nine stars of spokes, and beside each of them lines of one, two and three pixels. The
/// outermost pixels are white. The smaller the grey circle in a star's middle, the sharper the picture.
[[nodiscard]] image::Image8 focus_picture(int width, int height);

inline constexpr int grey_steps = 16;
/// Columns from black to white in even steps of the codes, each with its code, and a second row with the
/// codes near black and near white. If these look equal, the projector or the HDMI range clips them.
[[nodiscard]] image::Image8 grey_picture(int width, int height, const Typesetter& typesetter);

} // namespace frustumscreen::typography
