/// The prop: a convex solid whose lit faces are data.
///
/// Frame    prop P: origin at the centre of the bottom face, +Z up through the top. Metres.
/// Threads  values; any.
#pragma once

#include "app/geometry/per_corner.h"

#include <glm/glm.hpp>

#include <span>
#include <string>
#include <vector>

namespace frustumscreen::geometry {

/// A plane n.x = offset with a unit normal.
struct Plane {
    glm::dvec3 normal{0.0, 0.0, 1.0};
    double offset = 0.0;
    [[nodiscard]] double distance(const glm::dvec3& p) const { return glm::dot(normal, p) - offset; }
};

/// One face that can be lit, a convex polygon; corners counter-clockwise seen from outside.
struct PropFace {
    std::string name; ///< unique; of a frustum or a cube: the axis that its normal is closest to, e.g. "+X"
    Plane plane;      ///< normal points outward
    PerCorner<glm::dvec3> corners;
    /// Mean of the corners.
    [[nodiscard]] glm::dvec3 middle() const;
};

/// At most `max_faces` faces and `max_corners` corners (per_corner.h).
struct PropShape {
    /// In a frustum or a cube: the existing ones of +X, -X, +Y, -Y, +Z, -Z, in this order.
    std::vector<PropFace> faces;
    /// Bounding planes of the solid, outward: those of the faces first, then those that are never lit.
    std::vector<Plane> bounds;
    std::vector<glm::dvec3> corners; ///< of the solid, in no order
    glm::dvec3 middle{0.0};          ///< of the box around it
};

/// The corners on which the prop stands, those no more than 0.5 mm above the lowest one: one, two, or a polygon
/// counter-clockwise seen from above.
[[nodiscard]] std::vector<glm::dvec3> foot_of(const PropShape& prop);

/// Quarter turns about +Z after which the prop looks the same: 1 for a frustum or a cube, 2, or 4 for a whole turn.
[[nodiscard]] int quarters_to_same(const PropShape& prop);

/// A frustum between two squares; its sides face +-X and +-Y.
struct FrustumSize {
    double base_m = 0.16; ///< side of the bottom square
    double top_m = 0.09;  ///< side of the top square
    double height_m = 0.12;
};

/// The frustum of the shipped set-up (config/kiosk.toml).
inline constexpr FrustumSize shipped_frustum{0.30, 0.08, 0.155};
/// Five faces; the bottom stands on the table and is never lit.
[[nodiscard]] PropShape make_frustum(FrustumSize size);
/// Six faces: it is held in the hand at any orientation.
[[nodiscard]] PropShape make_cube(double edge_m);

/// The point where a ray enters the prop.
struct PropHit {
    double t = 0.0; ///< point = origin + t * direction
    int face = 0;   ///< index into `bounds`; for a face that can be lit, also into `faces`
};
/// Finds where a ray whose origin is outside enters the solid; false if it misses.
[[nodiscard]] bool enter(const PropShape& prop, const glm::dvec3& origin, const glm::dvec3& direction,
                         PropHit& hit);
/// As above, but only through one of `faces`; also false if the ray enters through a plane that is never lit.
[[nodiscard]] bool intersect(const PropShape& prop, const glm::dvec3& origin, const glm::dvec3& direction,
                             PropHit& hit);

/// The largest uniform scale about the origin that keeps every point inside the prop. The points' lowest must
/// be at z = 0, and they must be centred on the prop's axis. Infinite without points.
[[nodiscard]] double largest_scale_inside(const PropShape& prop, std::span<const glm::dvec3> points);

} // namespace frustumscreen::geometry
