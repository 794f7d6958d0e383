#include "assets_baked/bake/loaders/gltf_model.h"
#include "assets_baked/bake/loaders/refusal.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::bake {

namespace {

Wrap wrap_from(const JsonPlace& sampler, std::string_view key) {
    switch (const std::uint64_t value = sampler.whole_or(key, 10497)) {
    case 10497:
        return Wrap::Repeat;
    case 33071:
        return Wrap::Clamp;
    case 33648:
        return Wrap::Mirror;
    default:
        refuse_damage("{}.{}: {} is not a wrapping mode of glTF 2.0", sampler.path(), key, value);
    }
}

GltfImage image_from(const JsonPlace& place, const GltfModel& model) {
    GltfImage image;
    if (const auto uri = place.find("uri")) {
        image.uri = uri->text();
    }
    image.view = place.index_or_none("bufferView", model.views.size());
    if (image.uri.has_value() == image.view.has_value()) {
        refuse_damage("{}: either \"uri\" or \"bufferView\" is expected", place.path());
    }
    return image;
}

GltfTexture texture_from(const JsonPlace& place, const JsonPlace& document, const GltfModel& model) {
    GltfTexture texture;
    texture.image = place.index_or_none("source", model.images.size());
    if (const auto webp = extension_of(place, "EXT_texture_webp")) {
        texture.image = webp->at("source").index_into(model.images.size());
    }
    if (const auto sampler = place.index_or_none("sampler", document.size_of("samplers"))) {
        const JsonPlace modes = document.at("samplers")[*sampler];
        texture.wrap_u = wrap_from(modes, "wrapS");
        texture.wrap_v = wrap_from(modes, "wrapT");
    }
    return texture;
}

glm::dvec2 vec2_or(const JsonPlace& place, std::string_view key, const glm::dvec2& fallback) {
    const std::optional<JsonPlace> member = place.find(key);
    if (!member) {
        return fallback;
    }
    const std::vector<double> values = member->numbers(2);
    return {values[0], values[1]};
}

GltfTextureUse texture_use_from(const JsonPlace& place, const GltfModel& model) {
    GltfTextureUse use;
    use.texture = place.at("index").index_into(model.textures.size());
    use.uv_set = place.whole_or("texCoord", 0, 1000);
    if (const auto transform = extension_of(place, "KHR_texture_transform")) {
        use.offset = vec2_or(*transform, "offset", use.offset);
        use.scale = vec2_or(*transform, "scale", use.scale);
        use.rotation = transform->number_or("rotation", 0.0);
        use.uv_set = transform->whole_or("texCoord", use.uv_set, 1000);
    }
    return use;
}

glm::vec4 colour_from(const JsonPlace& place) {
    const std::vector<double> values = place.numbers(4);
    glm::vec4 colour;
    for (int i = 0; i < 4; ++i) {
        colour[i] = static_cast<float>(std::clamp(values[static_cast<std::size_t>(i)], 0.0, 1.0));
    }
    return colour;
}

void read_colour(const JsonPlace& place, const char* factor_key, const char* texture_key,
                 const GltfModel& model, GltfMaterial& material) {
    if (const auto factor = place.find(factor_key)) {
        material.base_colour = colour_from(*factor);
    }
    if (const auto texture = place.find(texture_key)) {
        material.texture = texture_use_from(*texture, model);
    }
}

/// The emission; its factor is black by default, even with a map.
glm::vec4 emission_of(const JsonPlace& place) {
    glm::vec4 light(0.0F, 0.0F, 0.0F, 1.0F);
    if (const auto factor = place.find("emissiveFactor")) {
        const std::vector<double> values = factor->numbers(3);
        for (int i = 0; i < 3; ++i) {
            light[i] = static_cast<float>(std::clamp(values[static_cast<std::size_t>(i)], 0.0, 1.0));
        }
    }
    return light;
}

bool is_black(const glm::vec4& colour) {
    return glm::vec3(colour) == glm::vec3(0.0F);
}

/// Exporters of shadeless materials write the colour as emission, over a black surface or one without a picture.
void read_emission(const JsonPlace& place, const GltfModel& model, GltfMaterial& material) {
    const glm::vec4 emission = emission_of(place);
    const std::optional<JsonPlace> texture = place.find("emissiveTexture");
    material.emits = !is_black(emission);
    if (material.emits && (is_black(material.base_colour) || (texture && !material.texture))) {
        material.base_colour = emission;
        material.texture = texture ? std::optional(texture_use_from(*texture, model)) : std::nullopt;
        material.emission_is_colour = true;
        material.emits = false;
    }
}

GltfMaterial material_from(const JsonPlace& place, const GltfModel& model) {
    GltfMaterial material;
    // The older workflow is still common in museums' downloads; its diffuse colour is closest to a base
    // colour.
    if (const auto glossiness = extension_of(place, "KHR_materials_pbrSpecularGlossiness")) {
        read_colour(*glossiness, "diffuseFactor", "diffuseTexture", model, material);
    } else if (const auto roughness = place.find("pbrMetallicRoughness")) {
        read_colour(*roughness, "baseColorFactor", "baseColorTexture", model, material);
    }
    const std::string alpha_mode = place.text_or("alphaMode", "OPAQUE");
    material.alpha_mask = alpha_mode == "MASK";
    material.blends = alpha_mode == "BLEND";
    material.alpha_cutoff = static_cast<float>(std::clamp(place.number_or("alphaCutoff", 0.5), 0.0, 2.0));
    material.normal_map = place.find("normalTexture").has_value();
    material.occlusion_map = place.find("occlusionTexture").has_value();
    material.unlit = extension_of(place, "KHR_materials_unlit").has_value();
    read_emission(place, model, material);
    return material;
}

} // namespace

glm::dvec2 GltfTextureUse::transformed(const glm::dvec2& uv) const {
    // Scale, then turn counter-clockwise as seen with v downwards, then shift, as in the extension's text, example and
    // test model; its GLSL code turns the other way.
    const double c = std::cos(rotation);
    const double s = std::sin(rotation);
    const glm::dvec2 scaled = uv * scale;
    return offset + glm::dvec2(c * scaled.x + s * scaled.y, -s * scaled.x + c * scaled.y);
}

void read_surface(const JsonPlace& document, GltfModel& model) {
    for (std::size_t i = 0; i < document.size_of("images"); ++i) {
        model.images.push_back(image_from(document.at("images")[i], model));
    }
    for (std::size_t i = 0; i < document.size_of("textures"); ++i) {
        model.textures.push_back(texture_from(document.at("textures")[i], document, model));
    }
    for (std::size_t i = 0; i < document.size_of("materials"); ++i) {
        model.materials.push_back(material_from(document.at("materials")[i], model));
    }
}

} // namespace frustumscreen::bake
