/// Small pictures, written by the libraries' own encoders.
#pragma once

#include "app/image/image.h"

#include <string>

namespace frustumscreen::testing {

/// Opaque, smooth ramps that JPEG keeps well.
Image8 smooth_picture(int width, int height);
std::string png_of(const Image8& image);
std::string jpeg_of(const Image8& image);
std::string webp_of(const Image8& image);
/// Written byte by byte after the formats' own descriptions; 24 bits a texel, without alpha.
std::string bmp_of(const Image8& image, bool top_row_first = false);
/// `packed`: in runs.
std::string tga_of(const Image8& image, bool packed = false);
enum class TiffAlpha { None, Apart, Multiplied };
/// `big`: byte order.
std::string tiff_of(const Image8& image, TiffAlpha alpha = TiffAlpha::None, bool big = false); ///< lossless
/// One row of grey codes 0, 1, 2, ... (16 bits: 256 even steps), with a gAMA note of 1.0 if asked for.
std::string grey_ramp_png(int depth, bool with_gamma);

} // namespace frustumscreen::testing
