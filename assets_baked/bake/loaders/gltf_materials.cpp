#include "assets_baked/bake/loaders/gltf_materials.h"

#include "assets_baked/bake/loaders/refusal.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

namespace frustumscreen::bake {

std::uint32_t GltfMaterials::material(std::optional<std::size_t> index) {
    const auto known = materials_.find(index);
    if (known != materials_.end()) {
        return known->second;
    }
    SourceMaterial made;
    if (index) {
        const GltfMaterial& source = model_.materials[*index];
        made.base_colour = source.base_colour;
        made.alpha_mask = source.alpha_mask;
        made.alpha_cutoff = source.alpha_cutoff;
        made.has_own_light = source.unlit || source.emission_is_colour;
        made.texture = source.texture ? texture(source.texture->texture) : -1;
        if (source.blends) {
            cut_or_fill(made, *index);
        }
    }
    return materials_[index] = mesh_.add_material(made);
}

void GltfMaterials::cut_or_fill(SourceMaterial& material, std::size_t index) {
    constexpr double max_between = 0.1; // share of the texels, at cut edges
    std::size_t clear = 0;
    std::size_t between = 0;
    const image::Image8* picture =
        material.texture < 0 ? nullptr : mesh_.texture(material.texture).image.get();
    for (std::size_t i = 0; picture != nullptr && i < picture->texels.size(); ++i) {
        const std::uint8_t alpha = picture->texels[i].a;
        clear += alpha < 8 ? 1 : 0;
        between += alpha >= 8 && alpha < 248 ? 1 : 0;
    }
    if (clear > 0 &&
        static_cast<double>(between) <= max_between * static_cast<double>(picture->texels.size())) {
        material.alpha_mask = true;
        material.alpha_cutoff = 0.5F;
        notes_.guessed("the picture of a material is all or nothing in its transparency, and is cut out "
                       "(alphaMode BLEND, materials[{}])",
                       index);
    } else if (clear + between > 0 || material.base_colour.a < 1.0F) {
        notes_.lost("the transparency of a material: it is shown opaque (alphaMode BLEND, materials[{}])",
                    index);
    }
}

int GltfMaterials::texture(std::size_t index) {
    const auto known = textures_.find(index);
    if (known != textures_.end()) {
        return known->second;
    }
    const GltfTexture& source = model_.textures[index];
    if (!source.image) {
        refuse("mesh.gltf_picture_format",
               "a picture is neither PNG, JPEG nor WebP; export the model with one of these (textures[{}])",
               index);
    }
    return textures_[index] = mesh_.add_texture({image(*source.image), source.wrap_u, source.wrap_v});
}

std::shared_ptr<const image::Image8> GltfMaterials::image(std::size_t index) {
    std::shared_ptr<const image::Image8>& known = images_[index];
    if (known) {
        return known;
    }
    const GltfImage& source = model_.images[index];
    const std::string place = fmt::format("images[{}]", index);
    if (source.view) {
        known = pictures_.decode(buffers_.view(*source.view), place);
    } else if (const std::optional<Bytes> inside = bytes_of_data_uri(*source.uri, place)) {
        known = pictures_.decode(*inside, place);
    } else {
        const std::string name = percent_decoded(*source.uri, place);
        known = pictures_.named(name, fmt::format("{}: {}", place, printable(name)));
    }
    return known;
}

} // namespace frustumscreen::bake
