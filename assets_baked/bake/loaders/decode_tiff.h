/// TIFF pictures: the first of the file, 1 to 16 bits a channel, grey, palette, RGB, with or without alpha, in
/// any packing that libtiff knows.
///
/// Colour   codes as stored; alpha that was multiplied into the colours is divided out.
/// Errors   damaged or truncated, floating point, more than `limit_texels`.
/// Threads  pure; any.
/// Library  libtiff, with its messages caught and each of its allocations bounded.
#pragma once

#include "app/image/image.h"
#include "assets_baked/bake/loaders/bytes.h"
#include "firmware_host/base/result.h"

#include <cstdint>

namespace frustumscreen::bake {

[[nodiscard]] bool is_tiff(ByteView bytes);
[[nodiscard]] Result<image::Image8> decode_tiff(ByteView bytes, std::int64_t limit_texels);

} // namespace frustumscreen::bake
