#include "app/geometry/picture_planes.h"

namespace frustumscreen::geometry {

std::array<Plane, 4> picture_planes(const Pinhole& pinhole, const RigidTransform& to_from_pinhole) {
    const std::array<glm::dvec2, 4> corners{glm::dvec2(0, 0), glm::dvec2(pinhole.width, 0),
                                            glm::dvec2(pinhole.width, pinhole.height),
                                            glm::dvec2(0, pinhole.height)};
    const double within = 1.0 / pinhole.lens.factors_within(pinhole.farthest_r2()).second;
    const auto ray = [&](const glm::dvec2& corner) {
        return glm::dvec3(within * glm::dvec2(pinhole.ideal().ray(corner)), 1.0);
    };
    std::array<Plane, 4> planes{};
    for (std::size_t k = 0; k < 4; ++k) {
        const glm::dvec3 inward =
            to_from_pinhole.direction(glm::normalize(glm::cross(ray(corners[k]), ray(corners[(k + 1) % 4]))));
        planes[k] = {inward, glm::dot(inward, to_from_pinhole.translation)};
    }
    return planes;
}

} // namespace frustumscreen::geometry
