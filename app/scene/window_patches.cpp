#include "app/scene/window_patches.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

namespace frustumscreen::scene {

const ldi::PointPatch* points_for(const WindowPatches& patches, const glm::dvec3& eye) {
    const double share = glm::length(eye) / patches.hemisphere.radius_m();
    const std::optional<std::size_t> patch = patches.hemisphere.patch_of(eye);
    return patch && share >= ldi::min_eye_share && share <= ldi::max_eye_share ? patches.patches[*patch]
                                                                               : nullptr;
}

void PointFade::step(const ldi::PointPatch* ready, double share) {
    const double passes = ready != nullptr ? share : -share;
    shown_.share = static_cast<float>(std::clamp(static_cast<double>(shown_.share) + passes, 0.0, 1.0));
    if (ready != nullptr || shown_.share == 0.0F) {
        shown_.points = ready;
    }
}

ShownPoints shown_to(const WindowPatches& patches, const glm::dvec3& eye) {
    if (patches.eye_count == 0) {
        return {.points = points_for(patches, eye)};
    }
    const auto nearer = [&](const WindowPatches::OfEye& one, const WindowPatches::OfEye& other) {
        return glm::distance(one.eye, eye) < glm::distance(other.eye, eye);
    };
    const auto eyes = std::span(patches.eyes).first(std::min(patches.eye_count, patches.eyes.size()));
    return std::min_element(eyes.begin(), eyes.end(), nearer)->shown;
}

Part part_of(const WindowPatches& patches, const ShownPoints& shown) {
    const geometry::Box& box = patches.box;
    const glm::dvec3 middle = 0.5 * (box.low + box.high);
    Part part;
    part.level.box_size = box.high - box.low;
    part.level.samples = patches.samples;
    part.level.prop_from_placed = glm::translate(glm::dmat4(1.0), {middle.x, middle.y, box.low.z});
    part.level.points = shown.points;
    if (shown.share < 1.0F) {
        part.dither = Dither{.share = shown.share};
    }
    return part;
}

RenderNeeds with_points(RenderNeeds needs) {
    needs.rasterizes = true;
    needs.draws.insert(raster_shader());
    return needs;
}

} // namespace frustumscreen::scene
