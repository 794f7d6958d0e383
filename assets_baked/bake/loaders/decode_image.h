/// Decodes a texture into 8-bit sRGB with alpha: PNG (any depth), JPEG, WebP, TIFF, BMP or TGA, told apart by
/// the first bytes.
///
/// Colour   profiles and gamma notes inside the files are ignored, as glTF 2.0 (3.8.1) asks: texels are sRGB.
/// Memory   the texels of the shrunk picture. WebP, BMP, TGA, interlaced PNG and the TIFF of decode_tiff.h lie in memory
///          whole before they are shrunk.
/// Errors   not one of these, damaged or truncated, animated; more than `limit_texels` in memory; more than
///          `max_coded_texels` (shrunk_image.h).
/// Threads  pure; any.
#pragma once

#include "app/image/image.h"
#include "assets_baked/bake/loaders/bytes.h"
#include "assets_baked/bake/loaders/shrunk_image.h"
#include "firmware_host/base/result.h"

#include <cstdint>

namespace frustumscreen::bake {

/// A 16k texture; 1 GiB as RGBA.
inline constexpr std::int64_t max_texture_texels = std::int64_t{1} << 28;

[[nodiscard]] Result<image::Image8> decode_image(ByteView bytes,
                                                 std::int64_t limit_texels = max_texture_texels);

/// Decodes a texture and halves it as often as `halvings` says.
[[nodiscard]] Result<ShrunkImage> decode_shrunk(ByteView bytes, const Halvings& halvings,
                                                std::int64_t limit_texels = max_texture_texels);

} // namespace frustumscreen::bake
