/// Input of a frame's rasterization: the eye, the rays through each visible face, and the pixels that light
/// the box's points.
///
/// Frames   box; pixels as in geometry/face_rays.h, of the ideal pinhole unless noted: a lens that distorts
///          lights other pixels.
/// Threads  pure; any.
/// Errors   a face that the eye or the projector sees at less than `min_sine` is left out
///          (geometry/collineation.h).
#pragma once

#include "app/geometry/face_rays.h"
#include "app/geometry/pinhole.h"
#include "firmware_host/base/pixel_rectangle.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace frustumscreen::relief {

struct RasterFace {
    int face = 0;              ///< index into the prop's faces
    glm::dmat3 direction{1.0}; ///< of the eye's ray, from (x, y, 1); box, not unit
    glm::dvec3 slant{0.0};     ///< FaceRays::slant: an affine map of the box changes neither it nor t
    geometry::PerCorner<glm::dvec3> edges{}; ///< times (x, y, 1): pixels inside the edge
    /// (x w, y w, w) of the pixel that lights a box point on this face; w > 0.
    glm::mat<4, 3, double> pixel_from_box{1.0};
    PixelRectangle lit; ///< the projector's pixels that may show the box on this face
};

/// Most faces have four edges or fewer. A test of many pixels against them unrolls these, and goes on with
/// `more_edges`, which most faces do not have. In a triangle the last edge counts twice.
[[nodiscard]] inline std::array<glm::vec3, 4> first_edges(const RasterFace& face) {
    return {face.edges[0], face.edges[1], face.edges[2], face.edges[face.edges.size() > 3 ? 3 : 2]};
}
[[nodiscard]] inline std::span<const glm::dvec3> more_edges(const RasterFace& face) {
    return std::span(face.edges).subspan(std::min<std::size_t>(face.edges.size(), 4));
}

struct RasterView {
    glm::dvec3 eye_box{0.0};
    std::vector<RasterFace> faces;
    PixelRectangle lit; ///< around all of them
    geometry::Pinhole projector;
};

/// The artifact's placement in the prop, the projector and the eye.
struct RasterScene {
    glm::dmat4 prop_from_box{1.0}; ///< affine
    glm::dvec3 box_size{1.0};
    geometry::Pinhole projector;
    geometry::RigidTransform prop_from_projector;
    glm::dvec3 eye_m{0.0}; ///< prop frame
};

/// `view` keeps its memory from frame to frame.
void set_up(RasterView& view, const geometry::PropShape& prop, const RasterScene& scene);

} // namespace frustumscreen::relief
