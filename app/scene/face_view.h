/// One face of the prop as one eye looks through it: what lies behind the face in clip coordinates, and the
/// pixels that it may light.
///
/// Frames   as named; clip coordinates as `Pinhole::clip_from_point`.
/// Threads  pure; any. Allocates nothing.
/// Errors   none: points that are not in front of the projector may be anywhere in the picture.
#pragma once

#include "app/geometry/collineation.h"
#include "app/geometry/pinhole.h"
#include "app/geometry/prop_shape.h"
#include "app/scene/lit_tiles.h"
#include "app/scene/visible_triangles.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace frustumscreen {

struct FaceView {
    glm::dvec3 eye_in_prop{0.0};
    glm::dmat4 clip_from_prop{1.0}; ///< the collineation of the face
    PixelRectangle bounds;          ///< of what may show on it
};

/// Pixels around points in clip coordinates of the ideal pinhole, where its lens brings them, with one pixel to spare on each
/// side; the whole picture if a point is not in front.
[[nodiscard]] PixelRectangle pixels_around(std::span<const glm::dvec4> clip, const Pinhole& pinhole);

/// Where a box can show on a face: the common part of the box seen through the face and of the face itself.
[[nodiscard]] PixelRectangle face_bounds(const PropFace& face, const Box& box,
                                         const glm::dmat4& clip_from_prop,
                                         const glm::dmat4& clip_through_face, const Pinhole& pinhole);

/// Depth 0 keeps what is in front of the projector (w > 0) and clips the rest.
[[nodiscard]] std::array<glm::vec4, 4> corners_in_clip(const std::array<glm::dvec3, 4>& corners,
                                                       const glm::dmat4& clip);

/// The pyramid eye -> face and the picture's edges seen through the face's collineation, straight ones around those that a
/// lens bends; box frame.
[[nodiscard]] FaceVolume volume_of(const PropFace& face, const glm::dvec3& eye_in_prop, double metres_per_box,
                                   const glm::dmat4& clip_from_box, const Pinhole& pinhole);

/// Marks the tiles that the triangles may light on a face: those of their common box, or of each triangle if
/// there are few in a large box. Returns the pixels around them all.
[[nodiscard]] PixelRectangle light_tiles(const LevelTriangles& level, std::size_t cluster,
                                         std::span<const std::uint32_t> visible,
                                         const glm::mat4& clip_from_box, const PixelRectangle& face,
                                         const Pinhole& pinhole, LitTiles& tiles);

/// Geometric mean of the two singular values of pixel(point) at a point: how large a picture the face makes
/// of it.
[[nodiscard]] double pixels_per_unit(const glm::dmat4& clip_from_box, const glm::dvec3& point,
                                     const Pinhole& pinhole);

} // namespace frustumscreen
