/// BMP and TGA pictures.
///
/// A TGA file has no mark at its beginning: `is_tga` returns true if its header is a possible one and begins like no
/// other kind of picture.
///
/// Errors   damaged or truncated, more than `limit_texels`.
/// Threads  pure; any.
/// Library  stb_image. It reads missing data as black and trusts the sizes, so both are checked here first.
#pragma once

#include "app/image/image.h"
#include "assets_baked/bake/loaders/bytes.h"
#include "firmware_host/base/result.h"

#include <cstdint>

namespace frustumscreen::bake {

[[nodiscard]] bool is_bmp(ByteView bytes);
[[nodiscard]] Result<image::Image8> decode_bmp(ByteView bytes, std::int64_t limit_texels);

[[nodiscard]] bool is_tga(ByteView bytes);
[[nodiscard]] Result<image::Image8> decode_tga(ByteView bytes, std::int64_t limit_texels);

} // namespace frustumscreen::bake
