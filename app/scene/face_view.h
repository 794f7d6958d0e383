/// One face of the prop as one eye looks through it: the space behind the face in clip coordinates, and the
/// pixels that it may light.
///
/// Frames   as named; clip coordinates as `Pinhole::clip_from_point`.
/// Threads  pure; any. Allocates nothing.
/// Errors   none: points that are not in front of the projector count as anywhere in the picture.
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

namespace frustumscreen::scene {

struct FaceView {
    glm::dvec3 eye_in_prop{0.0};
    glm::dmat4 clip_from_prop{1.0}; ///< the collineation of the face
    PixelRectangle bounds;          ///< of everything that may show on it
};

/// Pixels around points in clip coordinates of the ideal pinhole, after distortion by its lens, with a margin
/// of one pixel on each side; the whole picture if a point is not in front.
[[nodiscard]] PixelRectangle pixels_around(std::span<const glm::dvec4> clip,
                                           const geometry::Pinhole& pinhole);

/// The pixels where a box may show on a face: the intersection of the box seen through the face and the face
/// itself.
[[nodiscard]] PixelRectangle face_bounds(const geometry::PropFace& face, const geometry::Box& box,
                                         const glm::dmat4& clip_from_prop,
                                         const glm::dmat4& clip_through_face,
                                         const geometry::Pinhole& pinhole);

/// Depth 0 keeps points in front of the projector (w > 0) and clips the others.
[[nodiscard]] glm::vec4 corner_in_clip(const glm::dvec3& corner, const glm::dmat4& clip);

/// The pyramid from the eye through the face, and the picture's edges seen through the face's collineation;
/// edges bent by a lens are replaced by straight ones around them. Box frame: `placed_from_prop`, divided by
/// `metres_per_box`; `placed_from_prop` may mirror.
[[nodiscard]] FaceVolume volume_of(const geometry::PropFace& face, const glm::dvec3& eye_in_prop,
                                   const glm::dmat4& placed_from_prop, double metres_per_box,
                                   const glm::dmat4& clip_from_box, const geometry::Pinhole& pinhole);

/// Marks the tiles that the triangles may light on a face: those of their common box, or of each triangle if
/// a large box holds few triangles. Returns the pixels around all marked tiles.
[[nodiscard]] PixelRectangle light_tiles(const LevelTriangles& level, std::size_t cluster,
                                         std::span<const std::uint32_t> visible,
                                         const glm::mat4& clip_from_box, const PixelRectangle& face,
                                         const geometry::Pinhole& pinhole, LitTiles& tiles);

/// Geometric mean of the two singular values of pixel(point) at a point: the magnification of the picture on
/// the face.
[[nodiscard]] double pixels_per_unit(const glm::dmat4& clip_from_box, const glm::dvec3& point,
                                     const geometry::Pinhole& pinhole);

/// FacePlan::depth_from_nearness, of the face's collineation.
[[nodiscard]] glm::vec4 depth_from_nearness(const geometry::PropFace& face, const glm::dmat4& clip_from_prop,
                                            const glm::dmat4& projector_from_prop);

} // namespace frustumscreen::scene
