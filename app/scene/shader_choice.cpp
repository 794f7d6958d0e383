#include "app/scene/shader_choice.h"

#include <algorithm>
#include <vector>

namespace frustumscreen::scene {

namespace {

/// Shaders for each quality level, in each light and, if levels fade, dithered too. A relief rasterized on
/// the processor gets its light there.
void choose_quality_level_shaders(bool plain_light, bool even_light, bool fades, ScenePlan& plan) {
    const auto any = [&](const auto& is) {
        return std::any_of(plan.quality_levels.begin(), plan.quality_levels.end(), is);
    };
    const bool is_raster =
        any([](const QualityLevel& quality_level) { return quality_level.relief && !quality_level.on_gpu; });
    const bool blocks = any([](const QualityLevel& quality_level) { return quality_level.on_gpu; });
    std::vector<ShaderKey> keys;
    for (const bool dithered : {false, true}) {
        if (dithered && !fades) {
            continue;
        }
        if (plain_light) {
            keys.push_back({.dithered = dithered, .even_light = false});
        }
        if (even_light) {
            keys.push_back({.dithered = dithered, .even_light = true});
        }
    }
    if (is_raster) {
        plan.needs.draws.insert(raster_shader());
    }
    for (ShaderKey key : keys) {
        if (!plan.levels.empty()) {
            plan.needs.draws.insert(key);
        }
        if (blocks) {
            key.blocks = true;
            plan.needs.draws.insert(key);
        }
    }
    plan.needs.rasterizes = is_raster && !plan.reliefs.empty();
}

/// Samples a pixel of the picture that the GPU draws into. A relief rasterized on the processor takes its
/// samples there.
int samples_of(const SceneRequest& request, const QualityLevel& quality_level) {
    if (quality_level.relief && !quality_level.on_gpu) {
        return 1;
    }
    const bool has_headroom = request.live && request.sample_headroom > 1;
    return has_headroom ? request.sample_headroom : std::max(quality_level.samples, request.sample_headroom);
}

} // namespace

void choose_shaders(const SceneRequest& request, bool signs, ScenePlan& plan) {
    const bool all = (plan.cull_kinds & UnusedShaders) == 0;
    const bool fades = all || std::any_of(plan.quality_levels.begin(), plan.quality_levels.end(),
                                          [&](const QualityLevel& quality_level) {
                                              return !quality_level.shows_as(plan.quality_levels.front());
                                          });
    const bool plain = all || !request.light;
    const bool even = all || request.light;
    RenderNeeds& needs = plan.needs;
    choose_quality_level_shaders(plain, even, fades, plan);
    if (even) {
        needs.draws.insert({ShaderKey::Pass::EdgeFeather});
    }
    if (!plan.captions.empty() || (plan.cull_kinds & UnusedCaptions) == 0 || signs) {
        needs.draws.insert({ShaderKey::Pass::TablePicture});
    }
    for (const QualityLevel& quality_level : plan.quality_levels) {
        needs.samples = std::max(needs.samples, samples_of(request, quality_level));
    }
    if (!plain) {
        plan.left_out.push_back({UnusedShaders, "the shader without light compensation",
                                 "the projector's light is evened out in every picture"});
    }
    if (!even) {
        plan.left_out.push_back(
            {UnusedShaders, "the shader with light compensation", "the light is left as it is"});
    }
    if (!fades) {
        plan.left_out.push_back(
            {UnusedShaders, "the shaders that fade from one level to another", "only one level is drawn"});
    }
}

} // namespace frustumscreen::scene
