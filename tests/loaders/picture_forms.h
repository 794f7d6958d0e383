/// Pictures in each form that PNG and TIFF have, written by libpng and libtiff.
#pragma once

#include "app/image/image.h"

#include <cstdint>
#include <string>

namespace frustumscreen::testing {

enum class Channels { Grey, GreyAlpha, Palette, Rgb, Rgba };

struct PictureForm {
    Channels channels = Channels::Rgba;
    int depth = 8;           ///< or 16; 16-bit values are near their 8-bit codes
    bool interlaced = false; ///< PNG
    int rows_a_strip = 7;    ///< TIFF; 0: tiles of 32 x 16
    bool packed = true;      ///< TIFF: LZW
    int orientation = 1;     ///< TIFF
};

/// Random texels that the form can hold: a palette has 200 colours.
image::Image8 random_picture_for(const PictureForm& form, int width, int height, std::uint32_t seed);
/// A palette's alpha is stored too.
std::string png_in_form(const image::Image8& image, const PictureForm& form);
/// A palette has no alpha, and other alpha is not multiplied into the colours.
std::string tiff_in_form(const image::Image8& image, const PictureForm& form);

} // namespace frustumscreen::testing
