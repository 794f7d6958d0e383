/// A small, low projector for the bench's tests. Frames: table T, metres.
#pragma once

#include "app/bench/truth/poses.h"

namespace frustumscreen::bench {

/// 0.9 m above the table's middle, looking straight down; the picture's rows run along X.
inline settings::Settings near_settings() {
    settings::Settings settings;
    settings.projector.pinhole = {640, 400, 1400.0, 1400.0, 320.0, 200.0};
    settings.projector.table_from_projector = {glm::dquat(0.0, 1.0, 0.0, 0.0), {0.0, 0.0, 0.9}};
    settings.prop = {settings::PropKind::Frustum, 0.16, 0.09, 0.12, settings::PropZone::Table};
    return settings;
}

/// The prop on the table, rotated by `yaw` radians; a visitor's eye.
inline BenchPose pose_at(double x_m, double y_m, double yaw) {
    return {{glm::angleAxis(yaw, glm::dvec3(0, 0, 1)), {x_m, y_m, 0.0}}, {0.1, -0.5, 0.5}};
}

} // namespace frustumscreen::bench
