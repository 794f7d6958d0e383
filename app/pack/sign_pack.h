/// Puts a signature into a pack's container.
///
/// Threads  pure; any.
/// Errors   as ZipReader: the pack must have been verified before.
#pragma once

#include "firmware_host/base/file.h"
#include "firmware_host/base/result.h"

#include <span>
#include <string_view>

namespace frustumscreen {

/// The pack with `signature` as its last entry, in place of the one that it may have. All other entries stay as they are packed.
[[nodiscard]] Result<Bytes> with_signature(std::span<const std::byte> pack, std::string_view signature);

} // namespace frustumscreen
