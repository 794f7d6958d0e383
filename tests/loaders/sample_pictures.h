/// Small pictures, written by the libraries' own encoders.
#pragma once

#include "app/image/image.h"

#include <string>

namespace frustumscreen::testing {

/// Opaque, with smooth ramps that survive JPEG.
image::Image8 smooth_picture(int width, int height);
std::string png_of(const image::Image8& image);
std::string jpeg_of(const image::Image8& image);
std::string webp_of(const image::Image8& image);
/// Written byte by byte from the formats' descriptions; 24 bits per texel, without alpha.
std::string bmp_of(const image::Image8& image, bool top_row_first = false);
/// `packed`: run-length encoded.
std::string tga_of(const image::Image8& image, bool packed = false);
enum class TiffAlpha { None, Apart, Multiplied };
/// `big`: byte order.
std::string tiff_of(const image::Image8& image, TiffAlpha alpha = TiffAlpha::None,
                    bool big = false); ///< lossless
/// One row of grey codes 0, 1, 2, ... (16 bits: 256 even steps), with a gAMA chunk of 1.0 if requested.
std::string grey_ramp_png(int depth, bool with_gamma);

} // namespace frustumscreen::testing
