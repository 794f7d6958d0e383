/// Viewpoints of the sheet's pictures.
///
/// Frames   table T, metres; pixels of the resulting picture.
/// Threads  pure; any.
#pragma once

#include "app/geometry/per_corner.h"
#include "app/simulation/visitor_view.h"

#include <vector>

namespace frustumscreen::programs {

/// The share of a picture's height that the prop fills.
inline constexpr double prop_share_of_height = 0.85;

/// The visitor's camera, turned slightly and zoomed until the prop fills its share of the height, or less if
/// it would be wider than the picture.
[[nodiscard]] simulation::VisitorCamera framed_camera(const simulation::VisitorScene& scene,
                                                      const glm::ivec2& size);

/// The visitor's camera, turned and zoomed to show the prop and the whole lit part of the table.
[[nodiscard]] simulation::VisitorCamera table_camera(const simulation::VisitorScene& scene,
                                                     const glm::ivec2& size);

/// A camera behind the visitor's shoulder, on the line of sight, so the artifact looks as the visitor sees
/// it; table and projector are in its picture.
[[nodiscard]] simulation::VisitorCamera room_camera(const simulation::VisitorScene& scene,
                                                    const glm::ivec2& size);

/// The corners of the projector's picture on the table, as far as its light reaches the table.
[[nodiscard]] std::vector<glm::dvec3> lit_corners(const simulation::VisitorScene& scene);

using FaceOutline = geometry::PerCorner<glm::dvec2>;
/// Corners of the prop's faces in the projector's picture; only faces in front of the lens.
[[nodiscard]] std::vector<FaceOutline> face_outlines(const simulation::VisitorScene& scene);

} // namespace frustumscreen::programs
