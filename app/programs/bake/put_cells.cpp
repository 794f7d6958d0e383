#include "app/programs/bake/put_cells.h"

#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/world_cells.h"

#include <fmt/format.h>

#include <utility>

namespace frustumscreen::programs {

namespace {

/// Keeps what moves a cell, with the cell's index in place of the node's.
template <typename Motion>
void keep_with_cell(std::vector<Motion>& motions, const std::vector<std::optional<std::size_t>>& cell_of) {
    std::erase_if(motions, [&](const Motion& each) { return !cell_of[each.cell]; });
    for (Motion& each : motions) {
        each.cell = *cell_of[each.cell];
    }
}

/// A behaviour that moves no cell is left out; the note about its parts says why.
void keep_with_cells(std::vector<pack::PackBehaviour>& behaviours,
                     const std::vector<std::optional<std::size_t>>& cell_of) {
    for (pack::PackBehaviour& each : behaviours) {
        keep_with_cell(each.behaviour.channels, cell_of);
        keep_with_cell(each.behaviour.springs, cell_of);
        keep_with_cell(each.behaviour.pendulums, cell_of);
    }
    std::erase_if(behaviours, [](const pack::PackBehaviour& each) {
        const world::Behaviour& moves = each.behaviour;
        return moves.channels.empty() && moves.springs.empty() && moves.pendulums.empty();
    });
}

} // namespace

Result<PutCells> put_cells(pack::Pack& pack, const bake::SourceMesh& mesh,
                           std::vector<pack::PackBehaviour> behaviours, const bake::BakeOptions& options,
                           std::vector<bake::SourceNote>& notes) {
    const std::string up = options.up.empty() ? std::string(1, mesh.default_up) : options.up;
    TRY(const bake::BoxFrame frame, bake::make_box_frame(mesh, {up, options.turn_deg, options.lift}));
    bake::WorldCells cells = bake::bake_cells(mesh, frame, options);
    notes.insert(notes.end(), cells.notes.begin(), cells.notes.end());
    for (std::size_t k = 0; k < cells.cells.size(); ++k) {
        pack::PackProvenance provenance = pack.provenance;
        provenance.source_triangles = cells.cells[k].triangles;
        cells.geometry[k].provenance = std::move(provenance);
    }
    keep_with_cells(behaviours, cells.cell_of);
    pack::PackWorld world{.cells = std::move(cells.cells), .behaviours = std::move(behaviours)};
    TRY_VOID(pack::put_world(pack, world, cells.geometry));
    return PutCells{std::move(world), std::move(cells.cell_of)};
}

} // namespace frustumscreen::programs
