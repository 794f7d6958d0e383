#include "app/scene/window_patches.h"

#include <glm/gtc/matrix_transform.hpp>

#include <optional>
#include <utility>

namespace frustumscreen::scene {

const ldi::PointPatch* points_for(const WindowPatches& patches, const glm::dvec3& eye) {
    const double share = glm::length(eye) / patches.hemisphere.radius_m();
    const std::optional<std::size_t> patch = patches.hemisphere.patch_of(eye);
    return patch && share >= ldi::min_eye_share && share <= ldi::max_eye_share ? patches.patches[*patch]
                                                                               : nullptr;
}

Part part_of(const WindowPatches& patches, const ldi::PointPatch& points) {
    const geometry::Box& box = patches.box;
    const glm::dvec3 middle = 0.5 * (box.low + box.high);
    Part part;
    part.level.box_size = box.high - box.low;
    part.level.samples = patches.samples;
    part.level.prop_from_placed = glm::translate(glm::dmat4(1.0), {middle.x, middle.y, box.low.z});
    part.level.points = &points;
    return part;
}

RenderNeeds with_points(RenderNeeds needs) {
    needs.rasterizes = true;
    needs.draws.insert(raster_shader());
    return needs;
}

} // namespace frustumscreen::scene
