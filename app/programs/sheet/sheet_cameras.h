/// From where the sheet's pictures are seen.
///
/// Frames   table T, metres; pixels of the picture that is made.
/// Threads  pure; any.
#pragma once

#include "app/simulation/visitor_view.h"

#include <array>
#include <vector>

namespace frustumscreen {

/// The share of a picture's height that the prop fills.
inline constexpr double prop_share_of_height = 0.85;

/// The visitor's camera, turned a little and zoomed until the prop fills its share of the height; less if it is wider than
/// the picture then.
[[nodiscard]] VisitorCamera framed_camera(const VisitorScene& scene, const glm::ivec2& size);

/// The visitor's camera, turned and zoomed until the prop and all of the table that the projector lights are in the picture.
[[nodiscard]] VisitorCamera table_camera(const VisitorScene& scene, const glm::ivec2& size);

/// A camera behind the visitor's shoulder, on the line of sight, so that the artifact looks as the visitor sees it; table
/// and projector are in its picture.
[[nodiscard]] VisitorCamera room_camera(const VisitorScene& scene, const glm::ivec2& size);

/// Where the corners of the projector's picture lie on the table; those whose light reaches it.
[[nodiscard]] std::vector<glm::dvec3> lit_corners(const VisitorScene& scene);

/// The prop's faces in the projector's picture, corner by corner; those in front of the lens.
[[nodiscard]] std::vector<std::array<glm::dvec2, 4>> face_outlines(const VisitorScene& scene);

} // namespace frustumscreen
