/// Checks a pack against its manifest in little memory: the manifest itself, that every part is there and matches
/// its hash, and that there are no other parts. Contents are checked as far as a pass over the bytes allows:
/// triangles and charts completely, pictures for their size. The loader of a part checks the rest (pack_file.h).
///
/// Memory   some megabytes, however large the parts are.
/// Errors   one line naming the part, as load_pack.
/// Threads  one caller.
#pragma once

#include "app/pack/pack_reader.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <functional>

namespace frustumscreen::pack {

/// `reader` must be fresh, and cannot be used afterwards. `progress` gets the number of unpacked bytes as they
/// pass.
[[nodiscard]] Result<void> check_parts(PackReader& reader,
                                       const std::function<void(std::uint64_t bytes)>& progress);

} // namespace frustumscreen::pack
