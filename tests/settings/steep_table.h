/// A set-up with easily checked figures: a steep prop 1.2 m below a projector of 1280 x 800.
#pragma once

#include "app/settings/settings.h"

namespace frustumscreen::settings {

[[nodiscard]] inline Settings steep_table() {
    Settings settings;
    settings.projector.pinhole = {1280, 800, 1920.0, 1920.0, 640.0, 400.0};
    settings.projector.table_from_projector.translation = {0.0, 0.0, 1.2};
    settings.prop = {PropKind::Frustum, 0.16, 0.09, 0.12, PropZone::Table};
    settings.exhibit.zone_frame = false;
    settings.exhibit.guidance = false;
    settings.exhibit.table_pictures = false;
    return settings;
}

} // namespace frustumscreen::settings
