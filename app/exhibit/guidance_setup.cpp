#include "app/exhibit/guidance_setup.h"

#include "app/settings/lit_zone.h"

namespace frustumscreen::exhibit {

guidance::GuidanceSetup guidance_setup(const settings::Settings& settings) {
    return {.prop = settings::make_prop(settings.prop),
            .projector = settings.projector.pinhole,
            .table_from_projector = settings.projector.table_from_projector,
            .min_sine_of_light = settings::min_sine_of_light,
            .in_hand = settings.prop.zone == settings::PropZone::Hand,
            .half_table_m = 0.5 * glm::dvec2(settings.table.width_m, settings.table.depth_m),
            .head_tracked = settings.eye.tracked};
}

} // namespace frustumscreen::exhibit
