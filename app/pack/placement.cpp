#include "app/pack/pack_file.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace frustumscreen::pack {

Placement place(const PackDescription& pack, const geometry::PropShape& prop) {
    // The box stands on z = 0 by definition. Rounding may put an extreme below; without this, the scale would then
    // become 0.
    std::vector<glm::dvec3> extremes = pack.extremes;
    for (glm::dvec3& extreme : extremes) {
        extreme.z = std::fmax(extreme.z, 0.0);
    }
    const double scale = pack.scale * geometry::largest_scale_inside(prop, extremes);
    return {scale, glm::scale(glm::dmat4(1.0), glm::dvec3(scale)) * pack.box_from_file};
}

} // namespace frustumscreen::pack
