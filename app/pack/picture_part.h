/// Pictures of a pack, from the reader of its container.
///
/// Errors   one line naming the part.
/// Threads  one caller.
#pragma once

#include "app/image/image.h"
#include "app/pack/pack_reader.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <string>

namespace frustumscreen::pack {

/// A colour picture, PNG or lossless WebP.
[[nodiscard]] Result<image::Image8> read_picture(PackReader& reader, const std::string& name,
                                                 std::int64_t max_texels);
/// Empty if the pack has none.
[[nodiscard]] Result<image::Image8> read_table_picture(PackReader& reader);

} // namespace frustumscreen::pack
