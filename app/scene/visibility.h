/// The places from which the prop may be seen and lit, as the settings allow. They prove which faces and
/// triangles never show.
///
/// An upright prop that may be turned can have an eye or the lens at any azimuth. So such a zone is a profile
/// turned about the prop's axis, and the farthest that it reaches along a direction n is
///     max over the profile's points of  |(n.x, n.y)| distance + n.z height,
/// a plane test that is exact for its convex hull: nothing is sampled. A profile's arc is replaced by the
/// tangents around it, which is farther out by 0.02 % at most, never nearer.
///
/// Frames   prop P, metres.
/// Threads  pure; any.
/// Errors   none. What cannot be bounded (a prop in the hand, a recording in which the prop may be lifted and
///          tilted) may be anywhere, and then nothing is proved.
#pragma once

#include "app/geometry/transform.h"
#include "app/settings/settings.h"

#include <glm/glm.hpp>

#include <vector>

namespace frustumscreen {

/// Where one point (the eye, the lens) may be.
struct PointZone {
    bool anywhere = true;
    std::vector<glm::dvec3> points;
    std::vector<glm::dvec2> rings; ///< distance from the prop's axis, height; at every azimuth

    /// The largest dot(direction, point); infinite if anywhere.
    [[nodiscard]] double reach(const glm::dvec3& direction) const;
    /// The largest distance from the prop's origin.
    [[nodiscard]] double farthest() const;
};

/// Table frame.
struct KnownView {
    RigidTransform table_from_prop;
    glm::dvec3 eye_m{0.0};
};

struct Visibility {
    PointZone eyes, lens;
    std::vector<KnownView> views; ///< all views, if they are known; else empty
};

/// For the live exhibit: the eye's zone (EyeSettings, seen from the prop's foot) or the fixed eye, the prop
/// anywhere in its zone or fixed in the table's middle.
[[nodiscard]] Visibility visibility_of(const Settings& settings);
/// For a list of poses and no others.
[[nodiscard]] Visibility visibility_of(const Settings& settings, std::vector<KnownView> views);

} // namespace frustumscreen
