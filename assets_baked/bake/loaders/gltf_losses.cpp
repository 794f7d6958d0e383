#include "assets_baked/bake/loaders/gltf_losses.h"

#include "firmware_host/base/printable.h"

#include <fmt/ranges.h>

#include <algorithm>

namespace frustumscreen::bake {

namespace {

std::size_t count(const GltfModel& model, const std::set<std::size_t>& materials, bool GltfMaterial::*has) {
    return static_cast<std::size_t>(std::count_if(
        materials.begin(), materials.end(), [&](std::size_t each) { return model.materials[each].*has; }));
}

/// The largest number of morph targets of a mesh's primitives, which move together, summed over the meshes.
std::size_t morph_targets(const GltfModel& model) {
    std::size_t all = 0;
    for (const GltfMesh& mesh : model.meshes) {
        std::size_t most = 0;
        for (const GltfPrimitive& primitive : mesh.primitives) {
            most = std::max(most, primitive.targets.size());
        }
        all += most;
    }
    return all;
}

} // namespace

void note_gltf_losses(const GltfModel& model, const std::set<std::size_t>& drawn_materials,
                      LoadNotes& notes) {
    if (const std::size_t maps = count(model, drawn_materials, &GltfMaterial::normal_map); maps > 0) {
        notes.lost(
            "the normal maps of {}: their detail is not in the triangles; a scan with more triangles has it",
            counted(maps, "material", "materials"));
    }
    if (const std::size_t maps = count(model, drawn_materials, &GltfMaterial::occlusion_map); maps > 0) {
        notes.lost("the occlusion maps of {}: shadow in hollows; the museum light casts its own",
                   counted(maps, "material", "materials"));
    }
    if (const std::size_t glowing = count(model, drawn_materials, &GltfMaterial::emission_is_colour);
        glowing > 0) {
        notes.guessed("{} no colour; {} own light (emission) is used as the colour",
                      counted(glowing, "material has", "materials have"), glowing == 1 ? "its" : "their");
    }
    if (const std::size_t unlit = count(model, drawn_materials, &GltfMaterial::unlit);
        unlit > 0 && unlit < drawn_materials.size()) {
        notes.lost("that {} unlit (KHR_materials_unlit): the museum light falls on all materials alike",
                   counted(unlit, "material is", "materials are"));
    }
    if (!model.variants.empty()) {
        notes.lost("the variants of its materials ({}); it has the look that the file begins with",
                   printable(fmt::format("{}", fmt::join(model.variants, ", "))));
    }
    for (const std::string& extension : model.unknown_extensions) {
        notes.lost("what the extension {} of glTF adds; it is not read", printable(extension));
    }
    if (const std::size_t glowing = count(model, drawn_materials, &GltfMaterial::emits); glowing > 0) {
        notes.lost("the light that {} of {} own (emission)",
                   counted(glowing, "material gives", "materials give"), glowing == 1 ? "its" : "their");
    }
    if (model.animations > 0) {
        notes.lost("{}; it stands as the file has it before they begin",
                   counted(model.animations, "animation", "animations"));
    }
    if (const std::size_t targets = morph_targets(model); targets > 0) {
        notes.lost("{}; it stands in the shape that the file begins with",
                   counted(targets, "shape to change into (a morph target)",
                           "shapes to change into (morph targets)"));
    }
}

} // namespace frustumscreen::bake
