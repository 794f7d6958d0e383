/// A pack held against its manifest in little memory: what it says of itself, that every part is there and matches its hash, and
/// that nothing else is. Of what the parts hold, as much as can be seen while they pass by: triangles and charts wholly, of
/// pictures the size. The rest is looked at by whoever loads them (pack_file.h).
///
/// Memory   some megabytes, however large the parts are.
/// Errors   one line naming the part, as load_pack.
/// Threads  one caller.
#pragma once

#include "app/pack/pack_reader.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <functional>

namespace frustumscreen {

/// `reader` is fresh, and used up by this. `progress` hears of unpacked bytes as they pass.
[[nodiscard]] Result<void> check_parts(pack_format::PackReader& reader,
                                       const std::function<void(std::uint64_t bytes)>& progress);

} // namespace frustumscreen
