#include "assets_baked/bake/loaders/gltf_world.h"

#include "assets_baked/bake/loaders/gltf_cells.h"
#include "assets_baked/bake/loaders/gltf_movements.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::bake {

namespace {

std::vector<GltfDraws> draws_of(const GltfModel& model, std::span<const DrawnNode> drawn) {
    std::vector<GltfDraws> draws(model.nodes.size(), GltfDraws::Nothing);
    std::size_t begin = 0;
    for (const DrawnNode& each : drawn) {
        if (each.end > begin) {
            draws[each.node] = model.nodes[each.node].skin ? GltfDraws::Skin : GltfDraws::Triangles;
        }
        begin = each.end;
    }
    return draws;
}

std::vector<bool> moved_by(const std::vector<SourceAnimation>& animations, std::size_t nodes) {
    std::vector<bool> moved(nodes, false);
    for (const SourceAnimation& animation : animations) {
        for (const world::Channel& channel : animation.channels) {
            moved[channel.cell] = true;
        }
    }
    return moved;
}

/// Gives up all movement if more nodes move than a world has cells.
GltfCells cells_within_limits(const GltfModel& model, const GltfTree& tree,
                              const std::vector<GltfDraws>& draws, std::vector<SourceAnimation>& animations,
                              LoadNotes& notes) {
    const auto cells = [&] {
        return gltf_cells_of(model, tree, draws, moved_by(animations, model.nodes.size()), world::max_cells);
    };
    std::optional<GltfCells> made = cells();
    if (!made) {
        notes.lost("all movements, since more than {} of its parts move; join parts before it is exported",
                   world::max_cells);
        animations.clear();
        made = cells();
    }
    if (made->joined > 0) {
        notes.guessed(
            "it has {} parts, {} are allowed: {} that do not move by themselves are joined to others",
            made->nodes.size() + made->joined, world::max_cells, made->joined);
    }
    return *std::move(made);
}

} // namespace

void add_gltf_world(const GltfModel& model, const GltfTree& tree, GltfBuffers& buffers,
                    std::span<const DrawnNode> drawn, SourceMesh& mesh, LoadNotes& notes) {
    const std::vector<GltfDraws> draws = draws_of(model, drawn);
    std::vector<SourceAnimation> animations = gltf_movements(model, tree, buffers, draws, notes);
    GltfCells cells = cells_within_limits(model, tree, draws, animations, notes);
    if (animations.empty() && cells.nodes.size() <= 1) {
        return;
    }
    for (SourceAnimation& animation : animations) {
        for (world::Channel& channel : animation.channels) {
            channel.cell = *cells.cell_of[channel.cell];
        }
    }
    for (const DrawnNode& each : drawn) {
        const std::size_t own = each.end - mesh.triangle_nodes.size();
        if (own > 0) {
            const std::optional<std::size_t> cell =
                draws[each.node] == GltfDraws::Skin ? cells.skin_cell : cells.cell_of[each.node];
            mesh.triangle_nodes.insert(mesh.triangle_nodes.end(), own, static_cast<std::uint32_t>(*cell));
        }
    }
    mesh.nodes = std::move(cells.nodes);
    mesh.animations = std::move(animations);
}

} // namespace frustumscreen::bake
