/// The prop: a convex solid whose lit faces are data.
///
/// Frame    prop P: origin at the centre of the bottom face, +Z up through the top. Metres.
/// Threads  values; any.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <span>
#include <string_view>
#include <vector>

namespace frustumscreen {

/// A plane n.x = offset with a unit normal.
struct Plane {
    glm::dvec3 normal{0.0, 0.0, 1.0};
    double offset = 0.0;
    [[nodiscard]] double distance(const glm::dvec3& p) const { return glm::dot(normal, p) - offset; }
};

/// One face that can be lit; corners counter-clockwise seen from outside.
struct PropFace {
    Plane plane; ///< outward
    std::array<glm::dvec3, 4> corners{};
};

enum class PropKind { Frustum, Cube };

struct PropSize {
    PropKind kind = PropKind::Frustum;
    double base_m = 0.16; ///< side of the bottom square
    double top_m = 0.09;  ///< side of the top square
    double height_m = 0.12;
};

struct PropShape {
    PropSize size;
    std::vector<PropFace> faces; ///< +X, -X, +Y, -Y, top; the bottom stands on the table and is not lit
    /// Bounding planes of the solid, outward: the faces and the bottom.
    std::vector<Plane> bounds;
};

[[nodiscard]] PropShape make_prop(const PropSize& size);
[[nodiscard]] std::string_view name_of(PropKind kind);

/// Where a ray enters the prop.
struct PropHit {
    double t = 0.0; ///< point = origin + t * direction
    int face = 0;   ///< index into `faces`
};
/// First face that the ray enters through, for an origin outside; nothing if it misses or enters by the
/// bottom.
[[nodiscard]] bool intersect(const PropShape& prop, const glm::dvec3& origin, const glm::dvec3& direction,
                             PropHit& hit);

/// The largest uniform scale about the origin that keeps every point inside the prop; the points' lowest is
/// at z = 0 and they are centred on the prop's axis. Infinite for no points.
[[nodiscard]] double largest_scale_inside(const PropShape& prop, std::span<const glm::dvec3> points);

} // namespace frustumscreen
