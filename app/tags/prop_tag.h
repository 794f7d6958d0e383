/// A tag and its pose on the prop.
///
/// Frames   the tag: origin at its middle, +X to its right and +Y to its top as printed, +Z out of the paper.
/// Threads  values.
#pragma once

#include "app/geometry/transform.h"

#include <array>

namespace frustumscreen::tags {

struct PropTag {
    int id = 0;
    double size_m = 0.03; ///< side of the black square
    geometry::RigidTransform prop_from_tag;

    /// Corners in the order of FoundTag::corners_px, in the prop's frame.
    [[nodiscard]] std::array<glm::dvec3, 4> corners() const {
        const double half = 0.5 * size_m;
        return {prop_from_tag.point({-half, half, 0.0}), prop_from_tag.point({half, half, 0.0}),
                prop_from_tag.point({half, -half, 0.0}), prop_from_tag.point({-half, -half, 0.0})};
    }
};

} // namespace frustumscreen::tags
