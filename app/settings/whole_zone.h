/// The zone of the table in which an artifact is seen whole: every part of the prop through which an eye sees it is
/// lit.
///
/// It is larger than the zone in which every seen face is lit (lit_zone.h), because eyes do not see an artifact
/// through the outer corners of a wide prop. The prop stands upright, turned to any yaw.
///
/// Frames   table T, metres; the artifact as the corners of its hull (pack/pack_hull.h), prop P.
/// Threads  pure; any. Takes some ten milliseconds.
/// Method   upright and at any yaw, the prop has the eyes' zone all around it wherever it stands. So the points of
///          the prop through which the eyes see the artifact are the same everywhere, and form circles about the
///          axis; the zone is where the picture holds all these circles. On a face the points form a convex set if
///          the eyes' zone is convex (seen_extent.cpp). The eyes' zone is cut into narrow wedges whose convex hulls
///          are taken: no point is missed, and the result is too large by about a millimetre.
#pragma once

#include "app/settings/polygon.h"
#include "app/settings/settings.h"

#include <glm/glm.hpp>

#include <span>
#include <vector>

namespace frustumscreen::settings {

/// Eyes all around the prop, by their distance and elevation seen from the middle of its foot.
struct EyesAround {
    double lowest_rad = 0.0;
    double nearest_m = 0.0;
    bool higher_and_farther = true; ///< false: at this elevation and distance alone
};
/// All eyes that the settings allow.
[[nodiscard]] EyesAround all_eyes(const EyeSettings& eye);
/// Eyes as far and as high as the default eye, seen from the table's middle.
[[nodiscard]] EyesAround eyes_like_default(const EyeSettings& eye);

/// How far from the prop's axis these eyes look through the prop, and at which heights: the convex outline of all
/// pairs (distance, height). Empty if they see nothing of the artifact.
[[nodiscard]] Polygon seen_extent(const geometry::PropShape& prop, const EyesAround& eyes,
                                  std::span<const glm::dvec3> hull);

struct WholeZone {
    Polygon places;      ///< of the prop's axis; convex, empty if there are none
    Rectangle rectangle; ///< the largest one along the axes about its centroid
};
/// In the hand it is the zone of lit_zone.h, because a face may look in any direction.
[[nodiscard]] WholeZone whole_zone(const Settings& settings, const EyesAround& eyes,
                                   std::span<const glm::dvec3> hull);

/// A typical artifact for planning: an ellipsoid, 0.65 times as wide as high, as large as fits into the prop.
[[nodiscard]] std::vector<glm::dvec3> usual_artifact(const geometry::PropShape& prop);

} // namespace frustumscreen::settings
