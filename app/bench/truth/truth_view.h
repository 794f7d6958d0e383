/// Eye and projector, seen from the prop.
///
/// Frames   prop P, metres.
/// Threads  values; any.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/transform.h"

namespace frustumscreen::bench {

struct TruthView {
    geometry::Pinhole projector;
    geometry::RigidTransform prop_from_projector;
    glm::dvec3 eye_m{0.0};
};

} // namespace frustumscreen::bench
