#include "assets_baked/bake/part_light.h"

namespace frustumscreen::bake {

PartLight::PartLight(const SourceScene& mesh, const std::optional<PlaceInWhole>& place) : alone_(mesh) {
    if (place) {
        at_rest_.emplace(*place->whole);
        origin_ = place->origin;
        scale_ = place->scale;
    }
}

float PartLight::at(const glm::vec3& place, const glm::vec3& normal) const {
    if (!at_rest_) {
        return alone_.at(place, normal);
    }
    const glm::vec3 in_whole(origin_ + scale_ * glm::dvec3(place));
    return at_rest_->is_hidden(in_whole, normal) ? alone_.at(place, normal) : at_rest_->at(in_whole, normal);
}

} // namespace frustumscreen::bake
