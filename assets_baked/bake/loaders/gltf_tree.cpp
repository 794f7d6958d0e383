#include "assets_baked/bake/loaders/gltf_tree.h"

#include "assets_baked/bake/loaders/refusal.h"

#include <algorithm>

namespace frustumscreen::bake {

GltfTree::GltfTree(const GltfModel& model) : model_(model), parent_(model.nodes.size()) {
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        for (const std::size_t child : model.nodes[i].children) {
            if (parent_[child]) {
                refuse_contradiction(
                    "nodes[{}]: is a child of nodes[{}] and of nodes[{}]; one parent is allowed", child,
                    *parent_[child], i);
            }
            parent_[child] = i;
        }
    }
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        if (!parent_[i]) {
            roots_.push_back(i);
        }
    }
    order_ = below(roots_, GltfNodes::All);
    if (order_.size() < model.nodes.size()) { // each has one parent at most, so the others form a circle
        std::vector<bool> reached(model.nodes.size(), false);
        for (const std::size_t node : order_) {
            reached[node] = true;
        }
        const auto lost = std::find(reached.begin(), reached.end(), false) - reached.begin();
        refuse_contradiction("nodes[{}]: is its own ancestor; the nodes' children run in a circle", lost);
    }
}

std::vector<std::size_t> GltfTree::below(const std::vector<std::size_t>& roots, GltfNodes nodes) const {
    std::vector<bool> seen(model_.nodes.size(), false);
    std::vector<std::size_t> order;
    const auto visit = [&](std::size_t node) {
        if (!seen[node] && (nodes == GltfNodes::All || model_.nodes[node].visible)) {
            seen[node] = true;
            order.push_back(node);
        }
    };
    std::for_each(roots.begin(), roots.end(), visit);
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::vector<std::size_t>& children = model_.nodes[order[i]].children;
        std::for_each(children.begin(), children.end(), visit);
    }
    return order;
}

std::vector<glm::dmat4> GltfTree::scene_from_nodes() const {
    std::vector<glm::dmat4> scene_from_node(model_.nodes.size());
    for (const std::size_t node : order_) {
        const glm::dmat4& own = model_.nodes[node].parent_from_node;
        scene_from_node[node] = parent_[node] ? scene_from_node[*parent_[node]] * own : own;
    }
    return scene_from_node;
}

} // namespace frustumscreen::bake
