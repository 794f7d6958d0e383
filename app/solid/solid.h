/// A convex body with few flat faces: the shape of a prop.
///
/// Frame    the file's. Metres.
/// Threads  values, pure functions; any.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/geometry/transform.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace frustumscreen::solid {

inline constexpr std::size_t min_faces = 4;
inline constexpr std::size_t max_faces = geometry::max_faces;

/// How far a corner may lie from its face's plane, and outside of another face's: a third of a projector's
/// pixel on the prop.
inline constexpr double flatness_m = 0.0002;

struct SolidFace {
    std::string name;                ///< unique
    geometry::Plane plane;           ///< normal points outward
    std::vector<glm::dvec3> corners; ///< three or more, counter-clockwise seen from outside
};

/// Whether it lies on z = 0 and looks down: a prop stands on it.
[[nodiscard]] bool is_underside(const SolidFace& face);

/// Faces that meet have exactly equal corners. Only `make_solid` makes one, and `moved`.
struct Solid {
    std::vector<SolidFace> faces; ///< in the order of the file
    std::vector<glm::dvec3> corners;
};

[[nodiscard]] double volume_of(const Solid& solid);
/// The faces' area, summed.
[[nodiscard]] double area_of(const SolidFace& face);

struct SolidBox {
    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};
};
[[nodiscard]] SolidBox box_around(const Solid& solid);

/// The least distance between two parallel planes that hold the solid between them, and their normal.
///
/// Method   the least width of a convex polyhedron is taken at a face and a corner, or at two edges (Houle,
///          Toussaint, Computing the width of a set, 1988): the least over the normals of all faces and the
///          cross products of all pairs of edges.
struct SolidWidth {
    double width_m = 0.0;
    glm::dvec3 normal{0.0, 0.0, 1.0};
};
[[nodiscard]] SolidWidth min_width(const Solid& solid);

[[nodiscard]] Solid moved(Solid solid, const geometry::RigidTransform& to_from);

} // namespace frustumscreen::solid
