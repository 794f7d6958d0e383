/// Hotspots: a point on the artifact's surface, a label beside the prop, and a thin line between them.
///
/// A hotspot is seen if the ray from the eye to it meets the surface from outside, meets no other part of the
/// artifact before, and enters the prop at a lit place. Rays are cast at one of the pack's coarser levels
/// (triangle_tree.h): the ray's end is lifted off the surface by a tolerance, which must be at least that level's
/// error.
///
/// The line lies on the table. It is part of the straight line from where the eye sees the point, on the table behind
/// the prop, to the nearest place of the label: the part that is neither hidden by the prop from the eye nor covered
/// by its shadow. The line therefore seems to leave the prop straight from the point, and it follows smoothly as the
/// prop turns. Where it would cross another picture it goes around with one bend; where one bend is not enough, there
/// is no line.
///
/// Frames   as stated for each value; metres.
/// Threads  pure; any. Allocates nothing.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/geometry/transform.h"
#include "app/geometry/triangle_tree.h"
#include "app/typography/captions.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace frustumscreen::exhibit {

/// Prop frame.
struct Hotspot {
    glm::dvec3 point_m{0.0};
    glm::dvec3 normal{0.0, 0.0, 1.0}; ///< unit, outward
};

/// The artifact's surface for ray casts.
struct Occluder {
    const geometry::TriangleTree* triangles = nullptr; ///< in a frame of its own
    glm::dmat4 triangles_from_prop{1.0};               ///< to that frame; affine
    double tolerance_m = 0.0;                          ///< in the prop frame; at least the triangles' error
};

/// The places of the prop that the projector lights: those of a face that is turned to it, inside its picture.
struct LitPlaces {
    std::uint32_t faces = 0; ///< bit k is face k of the prop
    /// The picture's edges, table frame; normals point into the picture (picture_planes.h). None: it has no end.
    std::span<const geometry::Plane> picture_edges{};
    geometry::RigidTransform table_from_prop{};
};

/// `eye_m`: prop frame.
[[nodiscard]] bool is_seen(const Hotspot& hotspot, const glm::dvec3& eye_m, const geometry::PropShape& prop,
                           const LitPlaces& lit, const Occluder& artifact);

struct LeaderLine {
    std::array<glm::dvec2, 3> points_m{}; ///< from the prop to the label, table frame
    std::size_t count = 0;
    [[nodiscard]] std::span<const glm::dvec2> points() const { return std::span(points_m).first(count); }
};

struct LeaderLineNeeds {
    glm::dvec3 point_m{0.0};                        ///< the hotspot, table frame
    glm::dvec3 eye_m{0.0};                          ///< table frame
    std::optional<typography::TablePolygon> shadow; ///< hidden_by_prop from the lens
    std::optional<typography::TablePolygon> hidden; ///< hidden_by_prop from the eye
    typography::TableRectangle label;
    std::span<const typography::TableRectangle> pictures; ///< not to be crossed
};

/// Nothing if the eye is not above the prop, the label touches shadow or prop, or pictures leave no way.
[[nodiscard]] std::optional<LeaderLine> leader_line(const LeaderLineNeeds& needs);

} // namespace frustumscreen::exhibit
