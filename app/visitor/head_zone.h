/// Which of a camera's pixels can show the head of somebody at the table, and which show the table itself.
///
/// A head is beside the table, no farther from its edge than somebody stands whose hand reaches the prop, and above its top; whatever else the camera sees,
/// the far wall's lower part, the ceiling, the projector, is left out.
/// Frames   table T, metres.
/// Threads  pure; any.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/transform.h"

#include <cstdint>
#include <vector>

namespace frustumscreen {

enum class Shows : std::uint8_t { Neither, Head, Table };

struct HeadZone {
    glm::dvec2 table_size_m{0.8, 0.5};
    double farthest_m = 0.5; ///< of a head's middle from the table's edge
    double lowest_m = 0.1;   ///< above the table: a child's chin
    double highest_m = 1.3;

    /// Distance of the place below a point from the table's edge; below 0: above the table.
    [[nodiscard]] double outside_m(const glm::dvec3& point_m) const;
    [[nodiscard]] bool holds(const glm::dvec3& point_m) const;
};

/// [height][width] of `camera`, row-major.
[[nodiscard]] std::vector<Shows> what_pixels_show(const HeadZone& zone, const Pinhole& camera,
                                                  const RigidTransform& table_from_camera);

} // namespace frustumscreen
