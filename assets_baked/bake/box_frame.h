/// The artifact's own normalised box, and its outermost vertices.
///
/// Frames   box: up axis turned to +Z, turned about it, bounding box centred on the Z axis, standing on z =
///          0, longest edge 1 (docs/conventions.md: placement). The box of a raised artifact still reaches
///          down to z = 0. 64-bit, so that an artifact far from its origin keeps its detail.
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/source_mesh.h"
#include "firmware_host/base/result.h"

#include <glm/glm.hpp>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::bake {

/// Counter-clockwise about the vertical axis; whole quarter turns are exact.
[[nodiscard]] glm::dmat3 turn_rotation(double turn_deg);

/// The rotation that turns the file's axis "x", "-x", "y", ... to +Z; nullopt for other words.
[[nodiscard]] std::optional<glm::dmat3> up_rotation(std::string_view up);

/// Orientation and height of the artifact in its box.
struct Standing {
    std::string up = "z";  ///< the file's axis that points up
    double turn_deg = 0.0; ///< about the vertical axis, counter-clockwise seen from above
    double lift = 0.0;     ///< above the box's bottom, in heights of the artifact
};

struct BoxFrame {
    glm::dmat4 box_from_file{1.0};
    glm::dvec3 box_size{1.0};
    double file_units_per_box = 1.0;  ///< length of the longest edge in the file's units
    glm::dmat3 turned_from_file{1.0}; ///< up axis to +Z, and turned about it
    glm::dvec3 low{0.0};              ///< of the turned artifact's bounding box, file units
    glm::dvec3 extent{1.0};           ///< of that bounding box
    double lift_box = 0.0;            ///< of the artifact's lowest point, box units
};

/// Only vertices that triangles use count. Errors: all vertices at one point, or extents beyond 1e-30..1e30.
[[nodiscard]] Result<BoxFrame> make_box_frame(const SourceMesh& mesh, const Standing& standing);

/// Positions in the box frame, one for each of the mesh's positions: rounded relative to the box's size,
/// whereas box_from_file rounds relative to the artifact's distance from its origin.
[[nodiscard]] std::vector<glm::dvec3> in_box(const SourceMesh& mesh, const BoxFrame& frame);
/// Positions in the box frame for the source of a pack, which stores only the matrix.
[[nodiscard]] std::vector<glm::dvec3> in_box(const SourceMesh& mesh, const glm::dmat4& box_from_file);

/// The points that limit the scale inside any prop that is symmetric in X and Y and has a convex outline:
/// vertices of the convex hulls of the (x, z) and (y, z) profiles.
[[nodiscard]] std::vector<glm::dvec3> profile_extremes(std::span<const glm::dvec3> points);

} // namespace frustumscreen::bake
