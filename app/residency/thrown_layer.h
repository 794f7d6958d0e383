/// Reads a layer of an artifact and of its cells from the pack.
///
/// Threads  any; slow.
/// Errors   as load_layer_texture and load_cell.
#pragma once

#include "app/residency/torch_contents.h"

namespace frustumscreen::residency {

[[nodiscard]] Result<ReadLayer> read_layer(const ThrownContents& thrown, std::size_t number);

} // namespace frustumscreen::residency
