#include "assets_baked/bake/loaders/gltf_model.h"
#include "assets_baked/bake/loaders/refusal.h"

namespace frustumscreen::bake {

namespace {

world::Interpolation interpolation_from(const JsonPlace& sampler) {
    const std::string text = sampler.text_or("interpolation", "LINEAR");
    if (text == "LINEAR") {
        return world::Interpolation::Linear;
    }
    if (text == "STEP") {
        return world::Interpolation::Step;
    }
    if (text == "CUBICSPLINE") {
        return world::Interpolation::CubicSpline;
    }
    refuse_damage("{}.interpolation: \"{}\" is not known; allowed are LINEAR, STEP and CUBICSPLINE",
                  sampler.path(), text.substr(0, 40));
}

GltfSampler sampler_from(const JsonPlace& place, const GltfModel& model) {
    return {.place = place.path(),
            .input = place.at("input").index_into(model.accessors.size()),
            .output = place.at("output").index_into(model.accessors.size()),
            .interpolation = interpolation_from(place)};
}

/// An extension's path is unknown, and no reason to refuse the file.
GltfPath path_from(const JsonPlace& target) {
    const std::string text = target.text_or("path", "");
    if (text == "translation") {
        return GltfPath::Translation;
    }
    if (text == "rotation") {
        return GltfPath::Rotation;
    }
    if (text == "scale") {
        return GltfPath::Scale;
    }
    return text == "weights" ? GltfPath::Weights : GltfPath::Unknown;
}

GltfAnimation animation_from(const JsonPlace& place, const GltfModel& model) {
    GltfAnimation animation;
    animation.name = gltf_name_of(place);
    const std::optional<JsonPlace> samplers = place.find("samplers");
    for (std::size_t i = 0; samplers && i < samplers->size(); ++i) {
        animation.samplers.push_back(sampler_from((*samplers)[i], model));
    }
    const std::optional<JsonPlace> channels = place.find("channels");
    for (std::size_t i = 0; channels && i < channels->size(); ++i) {
        const JsonPlace channel = (*channels)[i];
        const JsonPlace target = channel.at("target");
        animation.channels.push_back({.place = channel.path(),
                                      .sampler = channel.at("sampler").index_into(animation.samplers.size()),
                                      .node = target.index_or_none("node", model.nodes.size()),
                                      .path = path_from(target)});
    }
    return animation;
}

} // namespace

void read_animations(const JsonPlace& document, GltfModel& model) {
    const std::optional<JsonPlace> animations = document.find("animations");
    for (std::size_t i = 0; animations && i < animations->size(); ++i) {
        model.animations.push_back(animation_from((*animations)[i], model));
    }
}

} // namespace frustumscreen::bake
