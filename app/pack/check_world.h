/// Checks of a world's cells and behaviours beyond their syntax. The writer and the reader share them, so a world that
/// would be refused is never written. The cells' own packs are checked with the pack (pack_world.h).
///
/// Errors   one line: which cell or behaviour, its value, what is allowed.
/// Threads  pure; any.
#pragma once

#include "app/pack/pack_world.h"
#include "firmware_host/base/result.h"

#include <vector>

namespace frustumscreen::pack {

/// The tree, the poses at rest, the boxes. `pack` must have been checked.
[[nodiscard]] Result<void> check_cells(const std::vector<PackCell>& cells, const PackDescription& pack);
/// `NotRead`: the curves are empty.
enum class Curves { Read, NotRead };
/// The cells must have been checked.
[[nodiscard]] Result<void> check_behaviours(const PackWorld& world, const PackDescription& pack,
                                            Curves curves);

} // namespace frustumscreen::pack
