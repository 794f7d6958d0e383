#include "assets_baked/bake/loaders/gltf_cells.h"

#include "assets_baked/bake/loaders/unique_names.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace frustumscreen::bake {

namespace {

constexpr std::size_t no_node = std::numeric_limits<std::size_t>::max();

/// A node that may become a cell.
struct Candidate {
    std::size_t node = no_node;        ///< of the file; `no_node`: the still root of meshes with a skin
    std::optional<std::size_t> parent; ///< a candidate before it
    glm::dmat4 parent_from_base{1.0};
    world::LocalPose rest;
    std::size_t depth = 0;
    bool moves = false;
    bool joins = false; ///< is no cell: its triangles go to `parent`, or to the first still root
};

/// Parents first.
std::vector<Candidate> candidates_of(const GltfModel& model, const GltfTree& tree,
                                     const std::vector<GltfDraws>& draws, const std::vector<bool>& moved) {
    const std::vector<bool> matters = moves_triangles(tree, draws);
    std::vector<Candidate> candidates;
    std::vector<std::optional<std::size_t>> nearest(model.nodes.size());
    std::vector<glm::dmat4> nearest_from_node(model.nodes.size(), glm::dmat4(1.0));
    for (const std::size_t node : tree.order()) {
        const GltfNode& source = model.nodes[node];
        const std::optional<std::size_t> parent = tree.parent_of(node);
        nearest[node] = parent ? nearest[*parent] : std::nullopt;
        const glm::dmat4 nearest_from_parent = parent ? nearest_from_node[*parent] : glm::dmat4(1.0);
        if (!matters[node] || (draws[node] != GltfDraws::Triangles && !moved[node])) {
            nearest_from_node[node] = nearest_from_parent * source.parent_from_node;
            continue;
        }
        const std::optional<std::size_t> above = nearest[node];
        candidates.push_back({.node = node,
                              .parent = above,
                              .parent_from_base = source.has_matrix
                                                      ? nearest_from_parent * source.parent_from_node
                                                      : nearest_from_parent,
                              .rest = source.rest,
                              .depth = above ? candidates[*above].depth + 1 : 0,
                              .moves = moved[node],
                              .joins = false});
        nearest[node] = candidates.size() - 1;
    }
    return candidates;
}

std::optional<std::size_t> first_still_root(const std::vector<Candidate>& candidates) {
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        if (!candidates[k].parent && !candidates[k].moves) {
            return k;
        }
    }
    return std::nullopt;
}

/// Marks the deepest candidates that do not move until the others fit. False if too many move.
bool join(std::vector<Candidate>& candidates, std::optional<std::size_t> still_root, std::size_t max_cells) {
    if (candidates.size() <= max_cells) {
        return true;
    }
    std::vector<std::size_t> order;
    for (std::size_t k = candidates.size(); k-- > 0;) {
        if (!candidates[k].moves && k != still_root) {
            order.push_back(k);
        }
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return candidates[a].depth > candidates[b].depth; });
    const std::size_t excess = candidates.size() - max_cells;
    for (std::size_t k = 0; k < std::min(excess, order.size()); ++k) {
        candidates[order[k]].joins = true;
    }
    return order.size() >= excess;
}

} // namespace

std::vector<bool> moves_triangles(const GltfTree& tree, const std::vector<GltfDraws>& draws) {
    std::vector<bool> moves(draws.size(), false);
    for (auto node = tree.order().rbegin(); node != tree.order().rend(); ++node) {
        moves[*node] = moves[*node] || draws[*node] == GltfDraws::Triangles;
        if (const auto parent = tree.parent_of(*node); parent && moves[*node]) {
            moves[*parent] = true;
        }
    }
    return moves;
}

std::optional<GltfCells> gltf_cells_of(const GltfModel& model, const GltfTree& tree,
                                       const std::vector<GltfDraws>& draws, const std::vector<bool>& moved,
                                       std::size_t max_cells) {
    std::vector<Candidate> candidates = candidates_of(model, tree, draws, moved);
    const auto skin = std::find(draws.begin(), draws.end(), GltfDraws::Skin);
    if (skin != draws.end()) {
        candidates.emplace_back();
    }
    const std::optional<std::size_t> still_root = first_still_root(candidates);
    if (!join(candidates, still_root, max_cells)) {
        return std::nullopt;
    }
    GltfCells made{.nodes = {}, .cell_of = {}, .skin_cell = std::nullopt, .joined = 0};
    made.cell_of.resize(model.nodes.size());
    UniqueNames names;
    // For each candidate: the cell that it hangs from or is, that cell's frame from its own, and its triangles' cell.
    std::vector<std::optional<std::size_t>> nearest(candidates.size());
    std::vector<glm::dmat4> nearest_from_candidate(candidates.size(), glm::dmat4(1.0));
    std::vector<std::size_t> triangles_in(candidates.size(), 0);
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const Candidate& each = candidates[k];
        const std::optional<std::size_t> above = each.parent ? nearest[*each.parent] : std::nullopt;
        const glm::dmat4 above_from_base =
            (each.parent ? nearest_from_candidate[*each.parent] : glm::dmat4(1.0)) * each.parent_from_base;
        if (each.joins) {
            ++made.joined;
            nearest[k] = above;
            nearest_from_candidate[k] = above_from_base * each.rest.matrix();
            triangles_in[k] = each.parent ? triangles_in[*each.parent] : triangles_in[*still_root];
        } else {
            const std::size_t named =
                each.node == no_node ? static_cast<std::size_t>(skin - draws.begin()) : each.node;
            nearest[k] = triangles_in[k] = made.nodes.size();
            made.nodes.push_back({.name = names.of(model.nodes[named].name, "node", named),
                                  .parent = above,
                                  .parent_from_base = above_from_base,
                                  .rest = each.rest});
        }
        (each.node == no_node ? made.skin_cell : made.cell_of[each.node]) = triangles_in[k];
    }
    return made;
}

} // namespace frustumscreen::bake
