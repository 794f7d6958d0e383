#include "app/settings/settings.h"

#include <cassert>

namespace frustumscreen::settings {

PropSettings cube_settings(double edge_m) {
    return {.kind = PropKind::Cube,
            .base_m = edge_m,
            .top_m = edge_m,
            .height_m = edge_m,
            .zone = PropZone::Hand};
}

geometry::PropShape make_prop(const PropSettings& prop) {
    if (prop.kind == PropKind::Solid) {
        assert(prop.shape); // a reader of settings has read it
        return *prop.shape;
    }
    return prop.kind == PropKind::Cube ? geometry::make_cube(prop.base_m)
                                       : geometry::make_frustum({prop.base_m, prop.top_m, prop.height_m});
}

std::string_view baked_kind(const PropSettings& prop) {
    if (prop.zone == PropZone::Hand) {
        return name_of(PropKind::Cube);
    }
    return prop.kind == PropKind::Solid ? std::string_view() : name_of(prop.kind);
}

geometry::RigidTransform prop_from_tag(const TagSettings& tag) {
    const glm::dquat leaned = glm::angleAxis(glm::radians(tag.lean_deg), glm::dvec3(1.0, 0.0, 0.0));
    const glm::dquat turned = glm::angleAxis(glm::radians(tag.turn_deg), glm::dvec3(0.0, 0.0, 1.0));
    return {turned * leaned, tag.centre_m};
}

} // namespace frustumscreen::settings
