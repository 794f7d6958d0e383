/// Draws glTF primitives into a MeshAssembly: triangles, strips and fans, morph targets at their given
/// weights, skins in the pose of the file's nodes. Points and lines are left out.
///
/// Frames   scene coordinates.
/// Errors   throws Refusal naming the primitive or the accessor.
#pragma once

#include "assets_baked/bake/loaders/gltf_attribute.h"
#include "assets_baked/bake/loaders/gltf_draco.h"
#include "assets_baked/bake/loaders/mesh_assembly.h"

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::bake {

/// The placement of one instance of a mesh.
struct GltfPlacement {
    glm::dmat4 scene_from_mesh{1.0};
    /// For a skin, one for each joint; then scene_from_mesh is not used (glTF 2.0, 3.7.3.3).
    std::span<const glm::dmat4> scene_from_mesh_by_joint;
    std::span<const double> morph_weights;
};

class GltfPrimitives {
public:
    /// `material_of` gives the mesh's material for the file's material, or for none.
    using MaterialOf = std::function<std::uint32_t(std::optional<std::size_t>)>;

    GltfPrimitives(const GltfModel& model, GltfBuffers& buffers, MeshAssembly& mesh, MaterialOf material_of)
        : model_(model), buffers_(buffers), mesh_(mesh), material_of_(std::move(material_of)) {}

    void draw(const GltfPrimitive& primitive, const GltfPlacement& placement);
    /// Number of triangles from the accessors' counts, before any data are read.
    [[nodiscard]] std::size_t declared_triangles(const GltfPrimitive& primitive) const;

private:
    struct Streams;

    [[nodiscard]] Streams streams_of(const GltfPrimitive& primitive, const GltfPlacement& placement);
    [[nodiscard]] std::optional<GltfAttribute> attribute(const GltfPrimitive& primitive,
                                                         const std::string& name, const Streams& streams);
    /// Normals only shape the light, so unusable ones are left out and refuse no file.
    [[nodiscard]] std::optional<GltfAttribute> normals(const GltfPrimitive& primitive,
                                                       const Streams& streams);
    [[nodiscard]] const DracoMesh* draco_mesh(const GltfPrimitive& primitive);
    void add_skin(const GltfPrimitive& primitive, Streams& streams);
    void add_morphs(const GltfPrimitive& primitive, const GltfPlacement& placement, Streams& streams);
    void draw_corners(const Streams& streams, const GltfPlacement& placement, std::uint32_t material);
    [[nodiscard]] std::uint32_t corner(const Streams& streams, std::size_t i) const;
    [[nodiscard]] std::uint32_t vertex(const Streams& streams, const GltfPlacement& placement,
                                       std::uint32_t element);
    void begin_vertices(std::size_t count);

    const GltfModel& model_;
    GltfBuffers& buffers_;
    MeshAssembly& mesh_;
    MaterialOf material_of_;
    std::map<std::pair<std::size_t, std::map<std::string, std::uint32_t, std::less<>>>, DracoMesh> draco_;
    /// Element of the primitive -> vertex of the mesh; valid where `drawn_in_` is `drawing_`. Only the
    /// vertices that triangles use are made, and nothing is cleared between primitives that share long
    /// accessors.
    std::vector<std::uint32_t> vertex_of_;
    std::vector<std::uint32_t> drawn_in_;
    std::uint32_t drawing_ = 0;
};

} // namespace frustumscreen::bake
