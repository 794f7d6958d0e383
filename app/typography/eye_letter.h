/// A letter on the alignment pattern that says which eye sees what: an L for the left eye, an R for the right one. It is
/// in each eye's picture alone, so that a technician who closes one eye sees whether the glasses are right.
///
/// Place    two squares in the picture's upper right, L beside R: between the staff's words and the camera's picture,
///          where the pattern has least light. Anything else that lies there, such as the prop's edges, is drawn over
///          the letter.
/// Units    pixels.
/// Threads  as Typesetter.
/// Errors   none.
#pragma once

#include "app/image/image.h"
#include "app/typography/canvas.h"
#include "app/typography/text_image.h"
#include "firmware_host/base/pixel_rectangle.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>

namespace frustumscreen::typography {

struct EyeLetter {
    PixelRectangle square;               ///< of the pattern
    image::Image<std::uint8_t> coverage; ///< of the square
};

/// The left eye's letter, then the right eye's, for this pattern.
[[nodiscard]] std::array<EyeLetter, 2> eye_letters(const image::Image8& pattern,
                                                   const Typesetter& typesetter);
/// The letter's square of `picture`, with the letter below what is there.
[[nodiscard]] image::Image8 with_letter(const image::Image8& picture, const EyeLetter& letter, Colour colour);

} // namespace frustumscreen::typography
