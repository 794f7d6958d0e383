/// Finds cells where the file gives none (--cells auto): parts of the surface that, drawn each in its own way, take less time
/// than the whole at the same error. Most artifacts are quicker whole; then the pack stays as it is.
///
/// Decided by   part_cost.h, on a prop of usual size in the near set-up.
/// Errors       one line: as put_world.
/// Threads      as bake.h.
#pragma once

#include "app/pack/pack_world.h"
#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/source_mesh.h"

#include <string>

namespace frustumscreen::programs {

struct AutoCells {
    pack::PackWorld world; ///< empty: the artifact is drawn whole
    std::string why;       ///< with the figures
};

/// `pack`: the whole, baked with `options`; cells that pay are put into it.
[[nodiscard]] Result<AutoCells> put_auto_cells(pack::Pack& pack, const bake::SourceMesh& mesh,
                                               const bake::BakeOptions& options);

} // namespace frustumscreen::programs
