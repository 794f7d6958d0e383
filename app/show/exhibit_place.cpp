#include "app/show/exhibit_place.h"

#include "app/exhibit/guidance_setup.h"
#include "app/geometry/picture_planes.h"
#include "app/scene/stereo.h"
#include "app/settings/guided.h"
#include "app/settings/lit_zone.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen::show {

namespace {

/// A script has the buttons up to the last that it presses.
std::size_t buttons_of(const settings::PanelSettings& panel) {
    if (panel.kind != settings::PanelKind::Scripted) {
        return panel.buttons();
    }
    int count = 0;
    for (const settings::ScriptedPress& press : panel.script) {
        count = std::max(count, press.button + 1);
    }
    return static_cast<std::size_t>(count);
}

exhibit::TorchPlace torch_place(const settings::TorchSettings& torch) {
    return {.beam = torch.beam,
            .min_opening_rad = glm::radians(torch.min_opening_deg),
            .max_opening_rad = glm::radians(torch.max_opening_deg),
            .house_light = torch.house_light};
}

} // namespace

exhibit::ExhibitPlace exhibit_place(const settings::Settings& settings) {
    exhibit::ExhibitPlace place;
    place.prop = settings::make_prop(settings.prop);
    place.lens_m = settings.projector.table_from_projector.translation;
    place.picture_m = settings::picture_on_table(settings, 0.0);
    const std::array<geometry::Plane, 4> edges =
        geometry::picture_planes(settings.projector.pinhole, settings.projector.table_from_projector);
    place.picture_edges.assign(edges.begin(), edges.end());
    place.attract_place_m = settings::lit_rectangle(settings).centre_m;
    place.in_hand = settings.prop.zone == settings::PropZone::Hand;
    place.buttons = buttons_of(settings.panel);
    if (settings::guides_visitors(settings)) {
        place.guidance = exhibit::guidance_setup(settings);
    }
    // The exhibit can be calibrated with the buttons, and is not calibrated yet.
    place.staff_stays = settings.calibration.by_buttons && !settings.calibration.used &&
                        settings.tracker.kind != settings::TrackerKind::None &&
                        scene::keeps_pixels(settings::stereo_of(settings));
    place.table_pictures = settings::chooses_on_table(settings);
    if (settings.torch.exists()) {
        place.torch = torch_place(settings.torch);
    }
    if (settings.windows.exist()) {
        place.windows = {.count = settings.windows.count,
                         .size_m = {settings.windows.width_m, settings.windows.depth_m},
                         .live = settings.windows.live};
    }
    place.rest = Nanoseconds(std::llround(1e9 * settings.exhibit.rest_s));
    return place;
}

} // namespace frustumscreen::show
