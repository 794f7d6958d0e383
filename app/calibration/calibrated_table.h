/// A calibrated table: the model of touches or rests in the table's frame, for other programs.
///
/// Frames   table T: z = 0 on the table, its origin where the picture's middle pixel lights it, +X along the
///          picture's u there.
/// Threads  values; any.
#pragma once

#include "app/calibration/touch_model.h"

namespace frustumscreen::calibration {

struct CalibratedTable {
    geometry::Pinhole pinhole;
    geometry::RigidTransform table_from_projector;
    geometry::RigidTransform table_from_tracker;
    glm::dvec3 sensor_offset_m{0.0}; ///< the touched place in the sensor's frame
};

/// Nothing if the light of the picture's middle does not reach the table.
[[nodiscard]] std::optional<CalibratedTable> in_table_frame(const TouchModel& model);

} // namespace frustumscreen::calibration
