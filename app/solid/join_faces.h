/// Joins polygons that lie in one plane side by side, such as the triangles of an STL file, into faces.
///
/// Frame    that of the polygons. Metres.
/// Threads  pure; any.
/// Method   a face grows from its largest polygon, whose plane is the best known; a neighbour belongs to it if
///          all its corners lie in the plane. The plane is fitted again to the grown face, which then goes on
///          growing.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/solid/closed_mesh.h"

#include <cstdint>
#include <vector>

namespace frustumscreen::solid {

struct JoinedFace {
    geometry::Plane plane;               ///< normal points outward
    std::vector<std::uint32_t> polygons; ///< ascending
};

/// How far a polygon's corners may lie from the plane of the face that it joins: 0.12 mm for a prop of 12 cm.
[[nodiscard]] double joining_distance(const ClosedMesh& closed);

/// Ordered by their first polygons; each polygon belongs to one face.
[[nodiscard]] std::vector<JoinedFace> join_faces(const ClosedMesh& closed);

} // namespace frustumscreen::solid
