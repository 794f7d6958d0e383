/// Decodes a texture into 8-bit sRGB with alpha: PNG (any depth), JPEG, WebP, TIFF, BMP or TGA, told apart by
/// the first bytes.
///
/// Colour   profiles and gamma notes inside the files are ignored, as glTF 2.0 (3.8.1) asks: texels are sRGB.
/// Errors   not one of these, damaged or truncated, animated, more than `limit_texels`.
/// Threads  pure; any.
#pragma once

#include "app/image/image.h"
#include "assets_baked/bake/loaders/bytes.h"
#include "firmware_host/base/result.h"

#include <cstdint>

namespace frustumscreen {

/// A 16k texture; 1 GiB as RGBA.
inline constexpr std::int64_t max_texture_texels = std::int64_t{1} << 28;

[[nodiscard]] Result<Image8> decode_image(ByteView bytes, std::int64_t limit_texels = max_texture_texels);

} // namespace frustumscreen
