/// The eye's rays through a face of the prop, as functions of the projector's pixels.
///
/// Pixels   (x, y) from the picture's corner; a pixel's centre is at + 0.5. Functions linear in (x, y, 1) are
///          exact for every pixel.
/// Frame    the prop's, metres.
/// Threads  pure; any.
/// Source   derived here: S = P + (d - n.P) / (n.L) L for the light's ray L from the projector P onto the
///          plane n.S = d; n.L < 0 where the face is lit, so that -n.L (S - E) has the direction of S - E,
///          and is linear in L.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/prop_shape.h"
#include "app/geometry/transform.h"

#include <glm/glm.hpp>

namespace frustumscreen::geometry {

struct FaceRays {
    PerCorner<glm::dvec3> edges; ///< times (x, y, 1): not positive inside the face
    glm::dmat3 direction{1.0};   ///< times (x, y, 1): S - E, scaled by -n.L
    glm::dvec3 slant{0.0};       ///< times (x, y, 1): -n.L, for the ray L whose component along the axis is 1
};

[[nodiscard]] FaceRays face_rays(const PropFace& face, const Pinhole& projector,
                                 const RigidTransform& prop_from_projector, const glm::dvec3& eye_m);

} // namespace frustumscreen::geometry
