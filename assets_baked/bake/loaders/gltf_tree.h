/// The nodes of a glTF file as a tree.
///
/// Errors   throws Refusal: a node with two parents, or one that is its own ancestor.
#pragma once

#include "assets_baked/bake/loaders/gltf_model.h"

#include <optional>
#include <vector>

namespace frustumscreen::bake {

enum class GltfNodes { All, Visible };

class GltfTree {
public:
    explicit GltfTree(const GltfModel& model);

    [[nodiscard]] std::optional<std::size_t> parent_of(std::size_t node) const { return parent_[node]; }
    /// Nodes without a parent.
    [[nodiscard]] const std::vector<std::size_t>& roots() const { return roots_; }
    /// All nodes, parents first.
    [[nodiscard]] const std::vector<std::size_t>& order() const { return order_; }
    /// Every node below `roots`, parents first; for visible nodes, without hidden ones and their descendants.
    [[nodiscard]] std::vector<std::size_t> below(const std::vector<std::size_t>& roots,
                                                 GltfNodes nodes) const;
    /// One for each node.
    [[nodiscard]] std::vector<glm::dmat4> scene_from_nodes() const;

private:
    const GltfModel& model_;
    std::vector<std::optional<std::size_t>> parent_;
    std::vector<std::size_t> roots_;
    std::vector<std::size_t> order_;
};

} // namespace frustumscreen::bake
