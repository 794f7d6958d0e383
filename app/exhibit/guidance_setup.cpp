#include "app/exhibit/guidance_setup.h"

#include "app/settings/lit_zone.h"

namespace frustumscreen {

GuidanceSetup guidance_setup(const Settings& settings) {
    return {make_prop(settings.prop),
            settings.projector.pinhole,
            settings.projector.table_from_projector,
            min_sine_of_light,
            settings.prop.zone == PropZone::Hand,
            0.5 * glm::dvec2(settings.table.width_m, settings.table.depth_m),
            settings.eye.tracked};
}

} // namespace frustumscreen
