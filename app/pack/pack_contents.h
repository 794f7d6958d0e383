/// The contents of a pack's container, for reports: the parts and their sizes, not decoded.
///
/// Errors   as verify_pack, as far as the container and the manifest go.
/// Threads  pure; any.
#pragma once

#include "firmware_host/base/result.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::pack {

struct PackPart {
    std::string name;
    std::uint64_t bytes = 0;        ///< unpacked
    std::uint64_t stored_bytes = 0; ///< in the file
    std::string sha256;             ///< of the unpacked bytes; empty for the manifest, which lists the others
};

/// The manifest first, then the parts in its order.
[[nodiscard]] Result<std::vector<PackPart>> list_pack_parts(std::span<const std::byte> bytes);

} // namespace frustumscreen::pack
