/// The materials and pictures of a glTF file, added to the mesh when a primitive first needs them.
///
/// BLEND    a picture with an alpha of only 0 and 1 is cut as with MASK; any other is shown opaque, with a note.
/// Errors   throws Refusal.
#pragma once

#include "assets_baked/bake/loaders/gltf_buffers.h"
#include "assets_baked/bake/loaders/gltf_model.h"
#include "assets_baked/bake/loaders/load_notes.h"
#include "assets_baked/bake/loaders/mesh_assembly.h"
#include "assets_baked/bake/loaders/picture_store.h"

#include <map>
#include <memory>
#include <optional>

namespace frustumscreen::bake {

class GltfMaterials {
public:
    GltfMaterials(const GltfModel& model, GltfBuffers& buffers, PictureStore& pictures, LoadNotes& notes,
                  MeshAssembly& mesh)
        : model_(model), buffers_(buffers), pictures_(pictures), notes_(notes), mesh_(mesh) {}

    /// The mesh's number for a material of the file; without an index, glTF's default material.
    std::uint32_t material(std::optional<std::size_t> index);

private:
    void cut_or_fill(SourceMaterial& material, std::size_t index);
    [[nodiscard]] int texture(std::size_t index);
    [[nodiscard]] std::shared_ptr<const image::Image8> image(std::size_t index);

    const GltfModel& model_;
    GltfBuffers& buffers_;
    PictureStore& pictures_;
    LoadNotes& notes_;
    MeshAssembly& mesh_;
    std::map<std::optional<std::size_t>, std::uint32_t> materials_;
    std::map<std::size_t, int> textures_;
    std::map<std::size_t, std::shared_ptr<const image::Image8>> images_;
};

} // namespace frustumscreen::bake
