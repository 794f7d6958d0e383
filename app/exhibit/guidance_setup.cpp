#include "app/exhibit/guidance_setup.h"

#include "app/settings/lit_zone.h"

namespace frustumscreen::exhibit {

guidance::GuidanceSetup guidance_setup(const settings::Settings& settings) {
    const bool stereo = settings::stereo_of(settings) != settings::Stereo::Off;
    return {.prop = settings::make_prop(settings.prop),
            .projector = settings.projector.pinhole,
            .table_from_projector = settings.projector.table_from_projector,
            .min_sine_of_light = settings::min_sine_of_light,
            .in_hand = settings.prop.zone == settings::PropZone::Hand,
            .half_table_m = 0.5 * glm::dvec2(settings.table.width_m, settings.table.depth_m),
            .head_tracked = settings.eye.tracked,
            .interocular_m = stereo ? 1e-3 * settings.eye.interocular_mm : 0.0};
}

guidance::GuidedState guided_state(const guidance::GuidanceSetup& setup,
                                   const tracking::TrackedState& tracked_state) {
    guidance::GuidedState guided{tracked_state.table_from_prop, tracked_state.eye_m};
    if (setup.interocular_m > 0.0) {
        const auto [left_m, right_m] = tracking::eyes_of(tracked_state, setup.interocular_m);
        guided.to_right_eye_m = 0.5 * (right_m - left_m);
    }
    return guided;
}

} // namespace frustumscreen::exhibit
