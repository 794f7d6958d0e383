/// The places of eyes and lens that the settings allow, relative to the prop. They prove which faces and
/// triangles never show.
///
/// An upright prop that may be turned can have an eye or the lens at any azimuth. The zone of such a point is
/// a profile turned about the prop's axis, and the farthest that it reaches along a direction n is
///     max over the profile's points of  |(n.x, n.y)| distance + n.z height,
/// a plane test that is exact for the zone's convex hull, without sampling. Tangents replace a profile's arc:
/// they are farther out by at most 0.02 %, never nearer.
///
/// Frames   prop P, metres.
/// Threads  pure; any.
/// Errors   none. Zones that cannot be bounded (a prop in the hand; a recording, in which the prop may be
///          lifted and tilted) are `anywhere`, which proves nothing.
#pragma once

#include "app/geometry/transform.h"
#include "app/settings/settings.h"

#include <glm/glm.hpp>

#include <vector>

namespace frustumscreen::scene {

/// The possible places of one point (an eye or the lens).
struct PointZone {
    bool anywhere = true;
    std::vector<glm::dvec3> points;
    std::vector<glm::dvec2> rings; ///< distance from the prop's axis, height; at every azimuth
    double margin_m = 0.0; ///< in every direction around points and rings: stereo's eyes beside the middle

    /// The largest dot(direction, point); infinite if anywhere.
    [[nodiscard]] double reach(const glm::dvec3& direction) const;
    /// The largest distance from the prop's origin.
    [[nodiscard]] double farthest() const;
};

/// Table frame.
struct KnownView {
    geometry::RigidTransform table_from_prop;
    glm::dvec3 eye_m{0.0};
};

struct Visibility {
    PointZone eyes, lens;
    std::vector<KnownView> views; ///< all views, if they are known; otherwise empty
};

/// For the live exhibit: eyes in their zone (EyeSettings, relative to the prop's foot) or a fixed eye; the
/// prop anywhere in its zone or fixed in the table's middle.
[[nodiscard]] Visibility visibility_of(const settings::Settings& settings);
/// For a fixed list of poses.
[[nodiscard]] Visibility visibility_of(const settings::Settings& settings, std::vector<KnownView> views);

} // namespace frustumscreen::scene
