/// Decodes a texture into 8-bit sRGB with alpha: PNG (any depth), JPEG, WebP, TIFF, BMP or TGA, told apart by
/// the first bytes.
///
/// Colour   profiles and gamma notes inside the files are ignored, as glTF 2.0 (3.8.1) asks: texels are sRGB.
/// Errors   not one of these, damaged or truncated, animated, more than `limit_texels`.
/// Memory   the texels of the whole picture; of a JPEG that is shrunk, those of the shrunk one.
/// Threads  pure; any.
#pragma once

#include "app/image/image.h"
#include "assets_baked/bake/loaders/bytes.h"
#include "firmware_host/base/result.h"

#include <cstdint>

namespace frustumscreen::bake {

/// A 16k texture; 1 GiB as RGBA.
inline constexpr std::int64_t max_texture_texels = std::int64_t{1} << 28;

[[nodiscard]] Result<image::Image8> decode_image(ByteView bytes,
                                                 std::int64_t limit_texels = max_texture_texels);

/// A picture that may have been halved, several times.
struct ShrunkImage {
    image::Image8 image;
    glm::ivec2 file_size{0}; ///< texels, as in the file
};
/// Decodes a texture and halves it until it has at most `kept_texels`. `limit_texels` is for what must be decoded whole;
/// a JPEG is shrunk while it is decoded and may be larger.
[[nodiscard]] Result<ShrunkImage> decode_shrunk(ByteView bytes, std::int64_t kept_texels,
                                                std::int64_t limit_texels = max_texture_texels);

} // namespace frustumscreen::bake
