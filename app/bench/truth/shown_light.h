/// The even light that an exhibit shows its artifact in, at one point of the prop.
///
/// What an exhibit aims at is said in app/scene/light.h; here it is worked out from the point itself, where the exhibit's shaders work
/// it out from the pixel. Edges between faces are sharp here: what their softening (edge_feather.h) changes counts as an error.
///
/// Frames   prop P, metres; pixels as `Pinhole` has them. Light in units of a surface square to the projector at 1 m.
/// Threads  pure; any.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/prop_shape.h"

#include <vector>

namespace frustumscreen {

struct ShownLight {
    double reference = 0.0; ///< every place is dimmed to it
    double exposure = 1.0;  ///< of the artifact
    std::vector<double>
        most; ///< of each face of the prop: the largest gain, less than 1 where the light grazes it
};

/// Factor of linear light, exposure in it, of the place that the projector's ray through a pixel lights.
struct LitPlace {
    int face = 0; ///< index into PropShape::faces
    glm::dvec3 point_m{0.0};
    glm::dvec2 pixel{0.0};
};
[[nodiscard]] double shown_gain(const ShownLight& light, const PropShape& prop, const glm::dvec3& projector_m,
                                const Pinhole& pinhole, const LitPlace& place);

} // namespace frustumscreen
