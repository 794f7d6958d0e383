/// Bakes each node's triangles as an artifact of its own: the cells of a world (cell.h, pack_world.h).
///
/// Frames   cells hang in the whole artifact's box; at rest each lies where the whole has it.
/// Size     a cell has texels as large as the whole's, so fewer of them; `measuring` shrinks with it.
/// Light    at rest a cell has the whole's, with the shadows of the other cells (part_light.h).
/// Sides    a cell that moves, or from which something moves away, keeps those that no visitor sees at rest.
/// Told     a part in a frame that is pressed flat is no cell: its triangles stay with the part that it hangs from, and it
///          does not move. A cell without a surface has no geometry.
/// Threads  uses all cores; `progress` is called on the caller's thread.
#pragma once

#include "app/pack/pack_world.h"
#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/box_frame.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace frustumscreen::bake {

struct WorldCells {
    std::vector<pack::PackCell> cells;
    std::vector<pack::Pack> geometry; ///< one for each cell; the caller fills in provenance
    /// One for each of the mesh's nodes; none: no cell.
    std::vector<std::optional<std::size_t>> cell_of;
    std::vector<SourceNote> notes;
};

enum class CellSides {
    All,
    SeenAtRest,
    OfSite, ///< as SeenAtRest, of regions that a site shows large, too: fine texels, no reliefs, coarse levels
};
/// The mesh has nodes. `frame`: of the whole, as `options` make it.
[[nodiscard]] WorldCells bake_cells(const SourceMesh& mesh, const BoxFrame& frame, const BakeOptions& options,
                                    CellSides sides = CellSides::All);

} // namespace frustumscreen::bake
