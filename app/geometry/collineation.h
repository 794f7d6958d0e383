/// The picture's single transform, eye -> face plane -> projector: one 4x4 matrix for each face of the prop.
///
/// For the plane n.S = d (unit outward n), the eye E and its height above the plane e = n.E - d, the ray from
/// E through X meets the plane in
///     S(X) = (e X - (n.X - d) E) / (e - (n.X - d)),
/// which is linear in homogeneous X. The product with the projector's matrix takes artifact points directly
/// to the projector's pixels: one pass, no image in between, exact for points and for straight edges.
///
/// Its denominator e - (n.X - d) is the depth of X below the eye measured along n: positive for everything
/// that a visitor sees. Clip w is that depth times the depth of S from the projector. Along one eye ray S is
/// fixed, so w grows with the distance from the eye: depth = a w + b, divided by w, is monotone along it.
/// Frames   all arguments in one frame (the prop's). Metres.
/// Threads  pure; any.
/// Source   derived here; a plane-induced homology followed by a pinhole (Hartley & Zisserman, ch. 2.4
///          and 6).
#pragma once

#include "app/geometry/prop_shape.h"

#include <glm/glm.hpp>

#include <optional>
#include <span>

namespace frustumscreen::geometry {

/// Homogeneous 4x4 of S(X) above.
[[nodiscard]] glm::dmat4 eye_onto_plane(const Plane& plane, const glm::dvec3& eye);

/// An axis-aligned box.
struct Box {
    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};
};

/// Sine of the elevation above a face, of the eye or of the projector, below which the face is left dark:
/// 0.057 degrees. At this angle a face 0.16 m wide, seen from 0.35 m, is 1.6 minutes of arc across, which
/// good eyes just resolve; and the light smears one pixel of 0.6 mm over 0.6 m. The picture's condition
/// number is 1 / sine: at this limit clip w spans three of the seven decades of the 32-bit matrix; below it
/// the GPU's rounding would become visible.
inline constexpr double min_sine = 1e-3;

/// Clip coordinates (OpenGL) of points X as they must be drawn on `plane` for the eye; the depth row is
/// fitted so that the part of `box` in front of the eye's own plane fills the depth range. Scaled so that w
/// is about 1.
///
/// nullopt if the eye is not above the plane by `min_sine` times its distance from the box's centre.
[[nodiscard]] std::optional<glm::dmat4> collineation(const Plane& plane, const glm::dvec3& eye,
                                                     const glm::dmat4& projector_clip_from_frame,
                                                     const Box& box);

/// As above, for a world that reaches out of the prop: what lies before the face is cut off, where the face's plane is the nearest
/// depth, and no distance behind it is too far. `corners`: of the face, in the plane.
///
/// The depth row is k (d - n.X) - w: 0 <= (d - n.X) / w rises along an eye ray from 0 on the plane towards e / w(S) at infinity, and
/// w is linear over the plane, so that k = 2 min w(S) / e over the corners keeps all of it below the far end.
[[nodiscard]] std::optional<glm::dmat4> collineation_behind(const Plane& plane, const glm::dvec3& eye,
                                                            const glm::dmat4& projector_clip_from_frame,
                                                            std::span<const glm::dvec3> corners);

} // namespace frustumscreen::geometry
