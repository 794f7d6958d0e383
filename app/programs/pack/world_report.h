/// The cells and behaviours of a pack in the reports of frustumscreen-pack.
///
/// Frame    boxes in the prop's, at rest; metres in JSON, millimetres in text.
/// Errors   none: of a pack whose sections are damaged nothing is reported (`verify` tells the reason).
/// Threads  pure; any.
#pragma once

#include "app/pack/pack.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace frustumscreen::programs {

/// [{name, parent: name or null, triangles, box: [[x, y, z], [x, y, z]]}]. The box of a cell without geometry is that
/// of the cells that hang from it, null if they have none either.
[[nodiscard]] nlohmann::ordered_json cells_json(const pack::PackDescription& pack, double metres_per_box);
/// [{name, seconds, trigger}]
[[nodiscard]] nlohmann::ordered_json behaviours_json(const pack::PackDescription& pack);
/// A line for each cell and behaviour; empty without them.
[[nodiscard]] std::string world_text(const pack::PackDescription& pack, double mm_per_box);

} // namespace frustumscreen::programs
