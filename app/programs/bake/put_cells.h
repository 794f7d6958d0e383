/// Bakes a model's parts and puts them, with what moves them, into the pack.
///
/// Errors   one line: a part that cannot be baked, a world that a pack does not allow.
/// Threads  as bake.h.
#pragma once

#include "app/pack/pack_world.h"
#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/source_mesh.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace frustumscreen::programs {

struct PutCells {
    pack::PackWorld world;                           ///< as the pack has it
    std::vector<std::optional<std::size_t>> cell_of; ///< one for each node of the mesh; none: no cell
};

/// `behaviours`: with the mesh's nodes as cells. `options`: those of the whole pack, which was baked. Losses are
/// added to `notes`.
[[nodiscard]] Result<PutCells> put_cells(pack::Pack& pack, const bake::SourceMesh& mesh,
                                         std::vector<pack::PackBehaviour> behaviours,
                                         const bake::BakeOptions& options,
                                         std::vector<bake::SourceNote>& notes);

} // namespace frustumscreen::programs
