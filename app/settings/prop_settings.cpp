#include "app/settings/settings.h"

namespace frustumscreen {

PropSettings cube_settings(double edge_m) {
    return {PropKind::Cube, edge_m, edge_m, edge_m, PropZone::Hand};
}

PropShape make_prop(const PropSettings& prop) {
    return prop.kind == PropKind::Cube ? make_cube(prop.base_m)
                                       : make_frustum({prop.base_m, prop.top_m, prop.height_m});
}

RigidTransform prop_from_tag(const TagSettings& tag) {
    const glm::dquat leaned = glm::angleAxis(glm::radians(tag.lean_deg), glm::dvec3(1.0, 0.0, 0.0));
    const glm::dquat turned = glm::angleAxis(glm::radians(tag.turn_deg), glm::dvec3(0.0, 0.0, 1.0));
    return {turned * leaned, tag.centre_m};
}

} // namespace frustumscreen
