/// TIFF pictures: the first of the file, 1 to 16 bits a channel, grey, palette, RGB, with or without alpha, in
/// any packing that libtiff knows.
///
/// Colour   codes as stored; alpha that was multiplied into the colours is divided out.
/// Memory   the shrunk picture, and a row of tiles or 64 rows. A strip is unpacked whole, so a packed picture of one strip
///          lies in memory whole; so does one whose first row is not at the top.
/// Errors   damaged or truncated; floating point; more than `limit_texels` after shrinking, or at once.
/// Threads  pure; any.
/// Library  libtiff, with its messages caught and each of its allocations bounded.
#pragma once

#include "assets_baked/bake/loaders/bytes.h"
#include "assets_baked/bake/loaders/shrunk_image.h"
#include "firmware_host/base/result.h"

#include <cstdint>

namespace frustumscreen::bake {

[[nodiscard]] bool is_tiff(ByteView bytes);
[[nodiscard]] Result<ShrunkImage> decode_tiff(ByteView bytes, const Halvings& halvings,
                                              std::int64_t limit_texels);

} // namespace frustumscreen::bake
