/// Whether a bake makes cells of a file's parts, and why.
///
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <cstddef>
#include <string>

namespace frustumscreen::programs {

struct CellsChoice {
    bool nodes = false;
    bool found = false; ///< parts of the surface are tried as cells (auto_cells.h)
    std::string why;    ///< "its animations move 2 of its 5 parts"
};

/// `option`: of --cells; empty: nodes if something moves. `behaviours`: how many the folder's file has; `hides`: a state of it
/// hides parts.
[[nodiscard]] CellsChoice choose_cells(const std::string& option, const bake::SourceMesh& mesh,
                                       std::size_t behaviours, bool hides = false);

} // namespace frustumscreen::programs
