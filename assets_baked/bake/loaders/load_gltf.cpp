#include "assets_baked/bake/loaders/load_gltf.h"

#include "assets_baked/bake/loaders/gltf_losses.h"
#include "assets_baked/bake/loaders/gltf_materials.h"
#include "assets_baked/bake/loaders/gltf_primitive.h"
#include "assets_baked/bake/loaders/gltf_tree.h"
#include "assets_baked/bake/loaders/gltf_world.h"
#include "assets_baked/bake/loaders/source_about.h"
#include "firmware_host/base/json.h"
#include "firmware_host/base/printable.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace frustumscreen::bake {

namespace {

struct Container {
    std::string_view json;
    std::optional<ByteView> binary_chunk;
};

constexpr std::size_t glb_header_size = 12;
constexpr std::size_t glb_chunk_header_size = 8;
constexpr std::uint32_t glb_chunk_json = 0x4E4F534A;
constexpr std::uint32_t glb_chunk_binary = 0x004E4942;

/// Splits a GLB: a header, a JSON chunk, a binary chunk, possibly others (glTF 2.0, 4).
Container split_glb(ByteView file) {
    if (file.size() < glb_header_size + glb_chunk_header_size) {
        const bool has_version = file.size() >= 8;
        const std::uint32_t version = has_version ? load_little<std::uint32_t>(file, 4) : 2;
        if (version != 2) {
            refuse("mesh.glb_version", "GLB of version {} cannot be read, only of 2; export it as glTF 2.0",
                   version);
        }
        refuse_cut_short("GLB header: the file ends after {} bytes", file.size());
    }
    const auto version = load_little<std::uint32_t>(file, 4);
    if (version != 2) {
        refuse("mesh.glb_version", "GLB of version {} cannot be read, only of 2; export it as glTF 2.0",
               version);
    }
    const auto length = load_little<std::uint32_t>(file, 8);
    if (length > file.size()) {
        refuse_cut_short("GLB header: {} bytes are declared, the file has {}", length, file.size());
    }
    Container container;
    std::size_t position = glb_header_size;
    for (int chunk = 0; position + glb_chunk_header_size <= length; ++chunk) {
        const std::size_t size = load_little<std::uint32_t>(file, position);
        const auto type = load_little<std::uint32_t>(file, position + 4);
        position += glb_chunk_header_size;
        if (size > length - position) {
            refuse_contradiction("GLB chunk {}: {} bytes are declared, {} are left", chunk, size,
                                 length - position);
        }
        const ByteView data = file.subspan(position, size);
        if ((chunk == 0) != (type == glb_chunk_json)) {
            refuse_damage("GLB chunk {}: the first chunk, and no other, must be JSON", chunk);
        }
        if (chunk == 0) {
            container.json = as_text(data);
        } else if (chunk == 1 && type == glb_chunk_binary) {
            container.binary_chunk = data;
        }
        position += size;
    }
    if (container.json.empty()) {
        refuse_damage("GLB header: there is no JSON in the {} bytes that it declares", length);
    }
    return container;
}

nlohmann::json parse_json(std::string_view text) {
    try {
        return nlohmann::json::parse(text);
    } catch (const nlohmann::json::exception& error) {
        const std::string_view what = error.what();
        const std::size_t end_of_code = what.find("] ");
        refuse_damage("JSON: {}",
                      end_of_code == std::string_view::npos ? what : what.substr(end_of_code + 2));
    }
}

/// scene_from_joint times mesh_from_joint's inverse, for each joint (glTF 2.0, 3.7.3.1).
std::vector<glm::dmat4> joint_transforms(const GltfModel& model, GltfBuffers& buffers, std::size_t skin_index,
                                         const std::vector<glm::dmat4>& scene_from_node) {
    const GltfSkin& skin = model.skins[skin_index];
    std::optional<GltfAttribute> inverse_bind;
    if (skin.inverse_bind_matrices) {
        inverse_bind.emplace(model, buffers, *skin.inverse_bind_matrices);
        if (inverse_bind->components() != 16 || inverse_bind->type() != ComponentType::F32 ||
            inverse_bind->count() < skin.joints.size()) {
            refuse_contradiction(
                "skins[{}].inverseBindMatrices: a 4x4 matrix of floats for each of {} joints is expected",
                skin_index, skin.joints.size());
        }
    }
    std::vector<glm::dmat4> transforms;
    for (std::size_t joint = 0; joint < skin.joints.size(); ++joint) {
        glm::dmat4 joint_from_mesh(1.0);
        for (std::size_t i = 0; inverse_bind && i < 16; ++i) {
            joint_from_mesh[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = inverse_bind->value(joint, i);
        }
        transforms.push_back(scene_from_node[skin.joints[joint]] * joint_from_mesh);
    }
    return transforms;
}

class SceneDrawer {
public:
    SceneDrawer(const GltfModel& model, GltfBuffers& buffers, PictureStore& pictures, LoadNotes& notes)
        : model_(model), buffers_(buffers), notes_(notes), surfaces_(model, buffers, pictures, notes, mesh_),
          primitives_(model, buffers, mesh_, [this](auto index) { return surfaces_.material(index); }) {}

    SourceMesh draw() {
        const GltfTree tree(model_);
        const std::vector<glm::dmat4> scene_from_node = tree.scene_from_nodes();
        const std::vector<std::size_t>& roots = model_.scene_roots ? *model_.scene_roots : tree.roots();
        const std::vector<std::size_t> drawn = tree.below(roots, GltfNodes::Visible);
        if (const std::size_t hidden = tree.below(roots, GltfNodes::All).size() - drawn.size(); hidden > 0) {
            notes_.guessed("{} left out, since the file hides {} (KHR_node_visibility)",
                           counted(hidden, "part is", "parts are"), hidden == 1 ? "it" : "them");
        }
        check_size(drawn);
        std::vector<DrawnNode> parts;
        for (const std::size_t node : drawn) {
            draw_node(node, scene_from_node);
            parts.push_back({.node = node, .end = mesh_.triangle_count()});
        }
        if (model_.nodes.empty()) {
            for (const GltfMesh& mesh : model_.meshes) {
                draw_mesh(mesh, {glm::dmat4(1.0), {}, mesh.weights});
            }
        }
        note_gltf_losses(model_, materials_, notes_);
        note_lost_attributes(lost_attributes_, notes_);
        SourceMesh mesh = mesh_.finish(has_points_);
        add_gltf_world(model_, tree, buffers_, parts, mesh, notes_);
        mesh.is_unlit = !materials_.empty() &&
                        std::all_of(materials_.begin(), materials_.end(),
                                    [&](std::size_t each) { return model_.materials[each].unlit; });
        return mesh;
    }

private:
    /// Any number of nodes may draw a mesh; refuses too many triangles before memory is allocated.
    void check_size(const std::vector<std::size_t>& drawn) const {
        std::vector<std::size_t> triangles;
        for (const GltfMesh& mesh : model_.meshes) {
            std::size_t sum = 0;
            for (const GltfPrimitive& primitive : mesh.primitives) {
                sum += primitives_.declared_triangles(primitive);
            }
            triangles.push_back(sum);
        }
        std::size_t total = 0;
        for (const std::size_t node : drawn) {
            const std::size_t once = model_.nodes[node].mesh ? triangles[*model_.nodes[node].mesh] : 0;
            const std::size_t times = instances_of(model_.nodes[node]);
            total += once > 0 && times > max_triangles / once ? max_triangles + 1 : once * times;
            if (total > max_triangles) {
                refuse("mesh.gltf_too_many_triangles",
                       "it has more than {} triangles; simplify it first, for instance in MeshLab (at "
                       "nodes[{}], parts that "
                       "are used again counted again)",
                       max_triangles, node);
            }
        }
    }

    [[nodiscard]] std::size_t instances_of(const GltfNode& node) const {
        return node.instances.empty() ? 1 : model_.accessors[node.instances.begin()->second].count;
    }

    /// EXT_mesh_gpu_instancing: draws the mesh once for each row of the attributes.
    void draw_instances(const GltfNode& node, const GltfMesh& mesh, const GltfPlacement& node_placement) {
        const auto attribute = [&](std::string_view name,
                                   std::size_t components) -> std::optional<GltfAttribute> {
            const auto found = node.instances.find(name);
            if (found == node.instances.end()) {
                return std::nullopt;
            }
            GltfAttribute read(model_, buffers_, found->second);
            if (read.components() != components || read.count() != instances_of(node)) {
                refuse_contradiction("{}: {} rows of {} numbers are expected for {}", read.place(),
                                     instances_of(node), components, name);
            }
            return read;
        };
        const std::optional<GltfAttribute> translation = attribute("TRANSLATION", 3);
        const std::optional<GltfAttribute> rotation = attribute("ROTATION", 4);
        const std::optional<GltfAttribute> scale = attribute("SCALE", 3);
        for (std::size_t i = 0; i < instances_of(node); ++i) {
            GltfPlacement placement = node_placement;
            placement.scene_from_mesh = glm::translate(placement.scene_from_mesh,
                                                       translation ? translation->vec3(i) : glm::dvec3(0.0));
            if (rotation) {
                const glm::dquat turn(rotation->value(i, 3), rotation->value(i, 0), rotation->value(i, 1),
                                      rotation->value(i, 2));
                placement.scene_from_mesh *=
                    glm::length(turn) < 1e-6 ? glm::dmat4(1.0) : glm::mat4_cast(glm::normalize(turn));
            }
            placement.scene_from_mesh =
                glm::scale(placement.scene_from_mesh, scale ? scale->vec3(i) : glm::dvec3(1.0));
            draw_mesh(mesh, placement);
        }
    }

    void draw_node(std::size_t index, const std::vector<glm::dmat4>& scene_from_node) {
        const GltfNode& node = model_.nodes[index];
        if (!node.mesh) {
            return;
        }
        const GltfMesh& mesh = model_.meshes[*node.mesh];
        GltfPlacement placement;
        placement.scene_from_mesh = scene_from_node[index];
        placement.morph_weights = node.weights.empty() ? mesh.weights : node.weights;
        if (node.skin) {
            const auto [known, is_new] = joints_.try_emplace(*node.skin);
            if (is_new) {
                known->second = joint_transforms(model_, buffers_, *node.skin, scene_from_node);
            }
            placement.scene_from_mesh_by_joint = known->second;
        }
        if (!node.instances.empty()) {
            draw_instances(node, mesh, placement);
            return;
        }
        draw_mesh(mesh, placement);
    }

    void draw_mesh(const GltfMesh& mesh, const GltfPlacement& placement) {
        for (const GltfPrimitive& primitive : mesh.primitives) {
            note_losses(primitive, !placement.scene_from_mesh_by_joint.empty());
            primitives_.draw(primitive, placement);
        }
    }

    void note_losses(const GltfPrimitive& primitive, bool has_skin) {
        if (primitive.material) {
            materials_.insert(*primitive.material);
        }
        if (primitive.mode < 4) {
            has_points_ = true;
            notes_.lost("points or lines are left out ({})", primitive.place);
            return;
        }
        add_lost_attributes(model_, primitive, has_skin, lost_attributes_);
        const auto texture =
            primitive.material ? model_.materials[*primitive.material].texture : std::nullopt;
        if (texture && !primitive.attributes.contains(fmt::format("TEXCOORD_{}", texture->uv_set))) {
            notes_.lost("a picture does not show, because a part has no texture coordinates for it ({})",
                        primitive.place);
        }
    }

    const GltfModel& model_;
    GltfBuffers& buffers_;
    LoadNotes& notes_;
    bool has_points_ = false;
    std::set<std::size_t> materials_; ///< materials of the drawn primitives
    std::set<std::string> lost_attributes_;
    MeshAssembly mesh_{'y'};
    std::map<std::size_t, std::vector<glm::dmat4>> joints_; ///< transforms of each skin's joints
    GltfMaterials surfaces_;
    GltfPrimitives primitives_;
};

} // namespace

SourceMesh load_gltf(ByteView file, ModelFiles& files) {
    const Container container =
        as_text(file).starts_with("glTF") ? split_glb(file) : Container{as_text(file), std::nullopt};
    GltfModel model;
    {
        const nlohmann::json document = parse_json(container.json);
        model = gltf_model_from(JsonPlace(document, ""));
        files.about = about_of_gltf(document);
    }
    GltfBuffers buffers(model, files.sidecars, container.binary_chunk);
    for (const GltfImage& image : model.images) {
        if (image.uri) {
            files.sidecars.mention(percent_decoded_if_valid(*image.uri));
        }
    }
    return SceneDrawer(model, buffers, files.pictures, files.notes).draw();
}

} // namespace frustumscreen::bake
