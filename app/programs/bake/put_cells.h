/// Bakes a model's parts and puts them, with what moves them, into the pack.
///
/// Errors   one line: a part that cannot be baked, a world that a pack does not allow.
/// Threads  as bake.h.
#pragma once

#include "app/pack/pack_world.h"
#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/source_mesh.h"

#include <vector>

namespace frustumscreen::programs {

/// `behaviours`: with the mesh's nodes as cells. `options`: those of the whole pack, which was baked. What is lost is
/// added to `notes`. Returns the world as the pack has it.
[[nodiscard]] Result<pack::PackWorld> put_cells(pack::Pack& pack, const bake::SourceMesh& mesh,
                                                std::vector<pack::PackBehaviour> behaviours,
                                                const bake::BakeOptions& options,
                                                std::vector<bake::SourceNote>& notes);

} // namespace frustumscreen::programs
