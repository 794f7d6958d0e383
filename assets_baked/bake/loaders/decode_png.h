/// PNG pictures of any depth.
///
/// Colour   codes as stored: gamma and profile chunks are ignored.
/// Memory   the shrunk picture and one row; an interlaced picture lies in memory whole before it is shrunk.
/// Errors   damaged or truncated; more than `limit_texels` after shrinking, or of an interlaced picture.
/// Threads  pure; any.
/// Library  libpng.
#pragma once

#include "assets_baked/bake/loaders/bytes.h"
#include "assets_baked/bake/loaders/shrunk_image.h"
#include "firmware_host/base/result.h"

#include <cstdint>

namespace frustumscreen::bake {

[[nodiscard]] bool is_png(ByteView bytes);
[[nodiscard]] Result<ShrunkImage> decode_png(ByteView bytes, const Halvings& halvings,
                                             std::int64_t limit_texels);

} // namespace frustumscreen::bake
