/// Classifies a camera's pixels: those that can show a visitor's head, and those that show the table.
///
/// A head is beyond the table's edge, no farther than a person whose hand reaches the prop, and above the
/// table top. Everything else that the camera sees, such as the far wall's lower part, the ceiling or the
/// projector, is excluded.
/// Frames   table T, metres.
/// Threads  pure; any.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/transform.h"

#include <cstdint>
#include <vector>

namespace frustumscreen::visitor {

enum class Shows : std::uint8_t { Neither, Head, Table };

struct HeadZone {
    glm::dvec2 table_size_m{0.8, 0.5};
    double farthest_m = 0.5; ///< of a head's centre from the table's edge
    double lowest_m = 0.1;   ///< above the table: a child's chin
    double highest_m = 1.3;

    /// Distance of a point's vertical projection from the table's edge; negative: on the table.
    [[nodiscard]] double outside_m(const glm::dvec3& point_m) const;
    [[nodiscard]] bool holds(const glm::dvec3& point_m) const;
};

/// [height][width] of `camera`, row-major.
[[nodiscard]] std::vector<Shows> what_pixels_show(const HeadZone& zone, const geometry::Pinhole& camera,
                                                  const geometry::RigidTransform& table_from_camera);

} // namespace frustumscreen::visitor
