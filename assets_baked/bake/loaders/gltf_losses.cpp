#include "assets_baked/bake/loaders/gltf_losses.h"

#include "firmware_host/base/printable.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <utility>

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

bool is_of_skin(std::string_view attribute) {
    return attribute.starts_with("JOINTS_") || attribute.starts_with("WEIGHTS_");
}

/// True for an attribute without effect on the picture, and for those that are read.
bool is_harmless(std::string_view attribute, std::size_t components) {
    const bool may_be_colour = components == 3 || components == 4;
    return !may_be_colour || attribute == "POSITION" || attribute == "NORMAL" || attribute == "TANGENT" ||
           attribute == "COLOR_0" || attribute.starts_with("TEXCOORD_");
}

} // namespace

void add_lost_attributes(const GltfModel& model, const GltfPrimitive& primitive, bool has_skin,
                         std::set<std::string>& names) {
    std::set<std::string> of_skin_read;
    for (std::size_t set = 0;; ++set) {
        std::string joints = fmt::format("JOINTS_{}", set);
        std::string weights = fmt::format("WEIGHTS_{}", set);
        if (!primitive.attributes.contains(joints) || !primitive.attributes.contains(weights)) {
            break;
        }
        of_skin_read.insert({std::move(joints), std::move(weights)});
    }
    for (const auto& [name, accessor] : primitive.attributes) {
        const bool is_lost = is_of_skin(name) ? has_skin && !of_skin_read.contains(name)
                                              : !is_harmless(name, model.accessors[accessor].components);
        if (is_lost) {
            names.insert(name);
        }
    }
}

void note_lost_attributes(const std::set<std::string>& names, LoadNotes& notes) {
    if (!names.empty()) {
        notes.lost("the vertex attributes {}: colours are read from COLOR_0, joints and weights from pairs "
                   "numbered 0, 1, 2",
                   printable(fmt::format("{}", fmt::join(names, ", ")), 200));
    }
}

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
    if (const std::size_t targets = morph_targets(model); targets > 0) {
        notes.lost("{}; it stands in the shape that the file begins with",
                   counted(targets, "shape to change into (a morph target)",
                           "shapes to change into (morph targets)"));
    }
}

} // namespace frustumscreen::bake
