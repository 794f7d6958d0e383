/// A glTF 2.0 document as typed values. The type, range and reference of every member are checked once, here, so that
/// later code may index without checks. Bytes are not read.
///
/// Frames   node transforms are parent_from_node.
/// Errors   throws Refusal naming the JSON place.
/// Source   Khronos, glTF 2.0 Specification (ISO/IEC 12113:2022), and the extensions named beside the
///          members.
#pragma once

#include "app/world/behaviour.h"
#include "app/world/cell.h"
#include "assets_baked/bake/loaders/json_place.h"
#include "assets_baked/bake/source_mesh.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::bake {

/// Limit of a file's nodes: more are no work of a curator, and a world has at most `world::max_cells` cells.
inline constexpr std::size_t max_gltf_nodes = 500'000;

struct GltfBuffer {
    std::optional<std::string> uri; ///< none: the GLB's binary chunk
    std::uint64_t byte_length = 0;
    bool fallback = false; ///< EXT_meshopt_compression: a buffer for decoded data, which may have no bytes
};

enum class MeshoptMode { Attributes, Triangles, Indices };
enum class MeshoptFilter { None, Octahedral, Quaternion, Exponential };

/// EXT_meshopt_compression of a buffer view.
struct GltfMeshopt {
    std::size_t buffer = 0;
    std::uint64_t byte_offset = 0;
    std::uint64_t byte_length = 0;
    std::size_t byte_stride = 0;
    std::size_t count = 0;
    MeshoptMode mode = MeshoptMode::Attributes;
    MeshoptFilter filter = MeshoptFilter::None;
};

struct GltfBufferView {
    std::size_t buffer = 0;
    std::uint64_t byte_offset = 0;
    std::uint64_t byte_length = 0;
    std::optional<std::uint64_t> byte_stride;
    std::optional<GltfMeshopt> meshopt;
};

enum class ComponentType : std::uint16_t {
    I8 = 5120,
    U8 = 5121,
    I16 = 5122,
    U16 = 5123,
    U32 = 5125,
    F32 = 5126
};

struct GltfSparse {
    std::size_t count = 0;
    std::size_t indices_view = 0;
    std::uint64_t indices_offset = 0;
    ComponentType indices_type = ComponentType::U32;
    std::size_t values_view = 0;
    std::uint64_t values_offset = 0;
};

struct GltfAccessor {
    std::optional<std::size_t> view; ///< none: zeros
    std::uint64_t byte_offset = 0;
    std::uint64_t byte_stride = 0; ///< the view's, or tightly packed
    ComponentType type = ComponentType::F32;
    std::size_t components = 1;
    bool normalised = false;
    std::size_t count = 0;
    std::optional<GltfSparse> sparse;
};

struct GltfImage {
    std::optional<std::string> uri;
    std::optional<std::size_t> view;
};

struct GltfTexture {
    std::optional<std::size_t> image; ///< none: its image has a form that cannot be read
    Wrap wrap_u = Wrap::Repeat;
    Wrap wrap_v = Wrap::Repeat;
};

/// A material's use of a texture, with KHR_texture_transform.
struct GltfTextureUse {
    std::size_t texture = 0;
    std::uint64_t uv_set = 0;
    glm::dvec2 offset{0.0};
    glm::dvec2 scale{1.0};
    double rotation = 0.0; ///< radians

    [[nodiscard]] glm::dvec2 transformed(const glm::dvec2& uv) const;
};

struct GltfMaterial {
    glm::vec4 base_colour{1.0F};
    std::optional<GltfTextureUse> texture;
    bool alpha_mask = false;
    float alpha_cutoff = 0.5F;
    bool blends = false; ///< alphaMode BLEND
    bool unlit = false;  ///< KHR_materials_unlit
    /// Base colour and texture are the material's emission, because it has no other colour.
    bool emission_is_colour = false;
    bool normal_map = false; ///< these three maps are not shown (gltf_losses.h)
    bool occlusion_map = false;
    bool emits = false;
};

using GltfAttributes = std::map<std::string, std::size_t, std::less<>>; ///< POSITION -> accessor

/// KHR_draco_mesh_compression of a primitive.
struct GltfDraco {
    std::size_t view = 0;
    std::map<std::string, std::uint32_t, std::less<>> attributes; ///< POSITION -> Draco's unique id
};

struct GltfPrimitive {
    std::string place; ///< meshes[1].primitives[0]
    GltfAttributes attributes;
    std::optional<std::size_t> indices;
    std::optional<std::size_t> material;
    std::uint64_t mode = 4;
    std::vector<GltfAttributes> targets;
    std::optional<GltfDraco> draco;
};

struct GltfMesh {
    std::vector<GltfPrimitive> primitives;
    std::vector<double> weights; ///< weights of the morph targets
};

struct GltfNode {
    std::string name; ///< empty: none
    std::vector<std::size_t> children;
    std::optional<std::size_t> mesh;
    std::optional<std::size_t> skin;
    glm::dmat4 parent_from_node{1.0};
    bool has_matrix = false;     ///< instead of `rest`
    world::LocalPose rest;       ///< its translation, rotation (unit) and scale
    std::vector<double> weights; ///< empty: those of the mesh
    GltfAttributes
        instances;       ///< TRANSLATION, ROTATION, SCALE of EXT_mesh_gpu_instancing; empty: the mesh once
    bool visible = true; ///< KHR_node_visibility, for the node and its descendants
};

struct GltfSkin {
    std::vector<std::size_t> joints;
    std::optional<std::size_t> inverse_bind_matrices;
};

enum class GltfPath { Translation, Rotation, Scale, Weights, Unknown };

struct GltfSampler {
    std::string place; ///< animations[1].samplers[0]
    std::size_t input = 0;
    std::size_t output = 0;
    world::Interpolation interpolation = world::Interpolation::Linear;
};
struct GltfChannel {
    std::string place;
    std::size_t sampler = 0;
    std::optional<std::size_t> node; ///< none: glTF ignores the channel
    GltfPath path = GltfPath::Unknown;
};
struct GltfAnimation {
    std::string name; ///< empty: none
    std::vector<GltfSampler> samplers;
    std::vector<GltfChannel> channels;
};

struct GltfModel {
    bool quantised = false; ///< KHR_mesh_quantization is declared
    std::vector<GltfBuffer> buffers;
    std::vector<GltfBufferView> views;
    std::vector<GltfAccessor> accessors;
    std::vector<GltfImage> images;
    std::vector<GltfTexture> textures;
    std::vector<GltfMaterial> materials;
    std::vector<GltfMesh> meshes;
    std::vector<GltfNode> nodes;
    std::vector<GltfSkin> skins;
    std::vector<GltfAnimation> animations;
    std::vector<std::string> variants;           ///< KHR_materials_variants: their names
    std::vector<std::string> unknown_extensions; ///< used by the file, and possibly relevant for the picture
    /// Roots of the default scene, otherwise of scene 0; nothing if the file has no scenes.
    std::optional<std::vector<std::size_t>> scene_roots;
};

[[nodiscard]] GltfModel gltf_model_from(const JsonPlace& document);

/// Reads the parts about colour (gltf_surface.cpp).
void read_surface(const JsonPlace& document, GltfModel& model);
/// Reads the parts about placement (gltf_nodes.cpp).
void read_nodes(const JsonPlace& document, GltfModel& model);
/// Reads the parts about movement (gltf_animations.cpp).
void read_animations(const JsonPlace& document, GltfModel& model);

[[nodiscard]] std::size_t size_of(ComponentType type);
/// The extension's object at `place`.
[[nodiscard]] std::optional<JsonPlace> extension_of(const JsonPlace& place, std::string_view name);
/// The member "name"; empty without one, and where it is no text: no part is refused for its name.
[[nodiscard]] std::string gltf_name_of(const JsonPlace& place);
[[nodiscard]] GltfAttributes attributes_from(const JsonPlace& place, const GltfModel& model);

} // namespace frustumscreen::bake
