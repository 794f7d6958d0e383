/// Bodies with a profile around the vertical axis: round ones, and square ones with sharp corners.
///
/// Frame    as surface.h. Angle 0 looks to +Z, the front; angles grow counter-clockwise seen from above.
/// Threads  as surface.h and atlas.h.
#pragma once

#include "assets_baked/artifacts/atlas.h"
#include "assets_baked/artifacts/profile.h"
#include "assets_baked/artifacts/surface.h"

#include <functional>

namespace frustumscreen::artifacts {

inline constexpr double full_turn = 6.283185307179586;

/// A place of a body: u is 0..1 around, `along` the place on the profile.
struct TurnedPlace {
    double u = 0.0;
    double angle = 0.0; ///< -pi..pi
    Profile::Point along;
};

struct Turned {
    Profile profile; ///< from the axis to the axis: the body is closed
    AtlasStrip strip;
    int atlas_rows = 1024;
    /// Height above the profile, along its normal; empty: none. It is 0 at both ends.
    std::function<double(const TurnedPlace&)> raised_mm = {};
    /// Moves a raised place (radius, height) in its half-plane; empty: it stays.
    std::function<glm::dvec2(const TurnedPlace&, const glm::dvec2&)> moved = {};
};
[[nodiscard]] Patch turned(Turned body);

/// The same with a square section: the profile's radius is half of a side. `columns`: triangles' columns of a side.
[[nodiscard]] Patch squared(Turned body, int columns);

void paint_turned(const Turned& body, image::Image8& texture,
                  const std::function<glm::vec3(const TurnedPlace&)>& colour);

/// A round bar along a path, open at both ends, which lie within other parts.
struct Bar {
    std::function<glm::dvec3(double)> path;    ///< 0..1
    std::function<glm::dvec2(double)> half_mm; ///< across `side`, and across the other
    glm::dvec3 side{1.0, 0.0, 0.0};            ///< never along the path
    double length_mm = 100.0;
    AtlasStrip strip;
    int atlas_rows = 1024;
};
[[nodiscard]] Patch bar(Bar bar);

} // namespace frustumscreen::artifacts
