#include "app/settings/settings.h"

namespace frustumscreen {

PropSettings cube_settings(double edge_m) {
    return {PropKind::Cube, edge_m, edge_m, edge_m, PropZone::Hand};
}

PropShape make_prop(const PropSettings& prop) {
    return prop.kind == PropKind::Cube ? make_cube(prop.base_m)
                                       : make_frustum({prop.base_m, prop.top_m, prop.height_m});
}

} // namespace frustumscreen
