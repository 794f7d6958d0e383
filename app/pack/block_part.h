/// One relief of a pack, as the bytes of its part. FORMAT.md defines them.
///
/// Errors   `decode_blocks` takes outside bytes: one line, without the part's name (the caller knows it). Every count is checked
///          before memory is allocated for it, every number is finite and in its range.
/// Threads  pure; any.
#pragma once

#include "app/relief/block_relief.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/result.h"

#include <span>

namespace frustumscreen::pack {

/// `relief` as made by `bake_blocks`: opaque colours, the axes of pack.h.
[[nodiscard]] Bytes encode_blocks(const relief::BlockRelief& relief);
[[nodiscard]] Result<relief::BlockRelief> decode_blocks(std::span<const std::byte> bytes);

} // namespace frustumscreen::pack
