/// Chooses which nodes of a glTF file become the nodes of a SourceMesh: those that draw triangles, those that move
/// such a node, and one that stands still for all meshes with a skin. Nodes between them are folded into
/// `parent_from_base`.
///
/// Limit    of `max_cells` nodes: the deepest ones that do not move join the part that they hang from, and a root that
///          stands still joins the first such root.
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/loaders/gltf_tree.h"
#include "assets_baked/bake/source_mesh.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace frustumscreen::bake {

/// Triangles that a node draws itself. Those with a skin do not follow the node (glTF 2.0, 3.7.3.3).
enum class GltfDraws : std::uint8_t { Nothing, Triangles, Skin };

/// One for each node: true if it or a node below it draws triangles that follow it.
[[nodiscard]] std::vector<bool> moves_triangles(const GltfTree& tree, const std::vector<GltfDraws>& draws);

struct GltfCells {
    std::vector<SourceNode> nodes;
    /// Index into `nodes`, one for each node of the file that draws triangles or moves.
    std::vector<std::optional<std::size_t>> cell_of;
    std::optional<std::size_t> skin_cell; ///< of all triangles with a skin
    std::size_t joined = 0;               ///< parts that joined another one
};
/// Nothing if more nodes move than are allowed. `moved`: one for each node.
[[nodiscard]] std::optional<GltfCells> gltf_cells_of(const GltfModel& model, const GltfTree& tree,
                                                     const std::vector<GltfDraws>& draws,
                                                     const std::vector<bool>& moved, std::size_t max_cells);

} // namespace frustumscreen::bake
