#include "assets_baked/bake/loaders/gltf_model.h"
#include "assets_baked/bake/loaders/refusal.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace frustumscreen::bake {

namespace {

glm::dmat4 matrix_from(const JsonPlace& place) {
    const std::vector<double> values = place.numbers(16);
    glm::dmat4 matrix;
    for (int i = 0; i < 16; ++i) {
        matrix[i / 4][i % 4] = values[static_cast<std::size_t>(i)];
    }
    return matrix;
}

glm::dvec3 vec3_or(const JsonPlace& place, std::string_view key, double fallback) {
    const std::optional<JsonPlace> member = place.find(key);
    if (!member) {
        return glm::dvec3(fallback);
    }
    const std::vector<double> values = member->numbers(3);
    return {values[0], values[1], values[2]};
}

/// Reads the node's place in its parent: a matrix, or a translation, rotation and scale.
void read_transform(const JsonPlace& place, GltfNode& node) {
    const bool has_parts = place.find("translation") || place.find("rotation") || place.find("scale");
    if (const auto matrix = place.find("matrix")) {
        if (has_parts) {
            refuse_contradiction(
                "{}: has a matrix and a translation, rotation or scale; only one of the two is allowed",
                place.path());
        }
        node.has_matrix = true;
        node.parent_from_node = matrix_from(*matrix);
        return;
    }
    node.rest.translation = vec3_or(place, "translation", 0.0);
    node.rest.scale = vec3_or(place, "scale", 1.0);
    node.parent_from_node = glm::translate(glm::dmat4(1.0), node.rest.translation);
    if (const auto rotation = place.find("rotation")) {
        const std::vector<double> xyzw = rotation->numbers(4);
        const glm::dquat quaternion(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
        if (glm::length(quaternion) < 1e-6) {
            refuse_contradiction("{}: is not a rotation: its length is zero", rotation->path());
        }
        node.rest.rotation = glm::normalize(quaternion);
        node.parent_from_node *= glm::mat4_cast(node.rest.rotation);
    }
    node.parent_from_node = glm::scale(node.parent_from_node, node.rest.scale);
}

std::vector<std::size_t> indices_from(const JsonPlace& place, std::size_t size) {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < place.size(); ++i) {
        indices.push_back(place[i].index_into(size));
    }
    return indices;
}

GltfNode node_from(const JsonPlace& place, std::size_t node_count, const GltfModel& model) {
    GltfNode node;
    node.name = gltf_name_of(place);
    if (const auto children = place.find("children")) {
        node.children = indices_from(*children, node_count);
    }
    node.mesh = place.index_or_none("mesh", model.meshes.size());
    node.skin = place.index_or_none("skin", model.skins.size());
    read_transform(place, node);
    if (const auto weights = place.find("weights")) {
        node.weights = weights->numbers();
    }
    if (const auto instancing = extension_of(place, "EXT_mesh_gpu_instancing")) {
        node.instances = attributes_from(instancing->at("attributes"), model);
    }
    if (const auto visibility = extension_of(place, "KHR_node_visibility")) {
        node.visible = visibility->truth_or("visible", true);
    }
    return node;
}

GltfSkin skin_from(const JsonPlace& place, std::size_t node_count, const GltfModel& model) {
    GltfSkin skin;
    skin.joints = indices_from(place.at("joints"), node_count);
    skin.inverse_bind_matrices = place.index_or_none("inverseBindMatrices", model.accessors.size());
    return skin;
}

std::optional<std::vector<std::size_t>> scene_roots_from(const JsonPlace& document, const GltfModel& model) {
    const std::size_t scene_count = document.size_of("scenes");
    const std::optional<std::size_t> named = document.index_or_none("scene", scene_count);
    if (scene_count == 0) {
        return std::nullopt;
    }
    const JsonPlace scene = document.at("scenes")[named.value_or(0)];
    const std::optional<JsonPlace> roots = scene.find("nodes");
    return roots ? indices_from(*roots, model.nodes.size()) : std::vector<std::size_t>();
}

} // namespace

void read_nodes(const JsonPlace& document, GltfModel& model) {
    const std::size_t node_count = document.size_of("nodes");
    if (node_count > max_gltf_nodes) {
        refuse("mesh.gltf_too_many_nodes",
               "it has {} nodes, at most {} are allowed; join its parts before it is exported (nodes)",
               node_count, max_gltf_nodes);
    }
    for (std::size_t i = 0; i < document.size_of("skins"); ++i) {
        model.skins.push_back(skin_from(document.at("skins")[i], node_count, model));
    }
    for (std::size_t i = 0; i < node_count; ++i) {
        model.nodes.push_back(node_from(document.at("nodes")[i], node_count, model));
    }
    model.scene_roots = scene_roots_from(document, model);
}

} // namespace frustumscreen::bake
