#include "app/geometry/field_map.h"

namespace frustumscreen {

FieldMap::Terms FieldMap::terms(const glm::dvec3& reported) const {
    const glm::dvec3 at = glm::clamp(box_from_tracker.point(reported) / half_m, -1.0, 1.0);
    return {1.0,         at.x,        at.y,        at.z,        at.x * at.x,
            at.x * at.y, at.x * at.z, at.y * at.y, at.y * at.z, at.z * at.z};
}

glm::dvec3 FieldMap::place(const glm::dvec3& reported) const {
    const Terms at = terms(reported);
    glm::dvec3 shift(0.0);
    for (std::size_t k = 0; k < term_count; ++k) {
        shift += at[k] * shift_m[k];
    }
    return reported + box_from_tracker.inverse().direction(shift);
}

} // namespace frustumscreen
