#include "app/residency/on_table.h"

#include <optional>

namespace frustumscreen::residency {

void OnTable::add(const scene::TablePicture& picture) {
    if (picture.brightness > 0.0 && count_ < pictures_.size()) {
        pictures_[count_++] = picture;
    }
}

typography::TableRectangle on_pixels(typography::TableRectangle rectangle, const geometry::Pinhole& projector,
                                     const geometry::RigidTransform& table_from_projector) {
    const glm::dvec3 corner(rectangle.corners()[3], 0.0);
    const std::optional<glm::dvec2> pixel = projector.pixel(table_from_projector.inverse().point(corner));
    if (!pixel) {
        return rectangle;
    }
    const glm::dvec3 ray = table_from_projector.direction(projector.ray(glm::round(*pixel)));
    if (ray.z < 0.0) {
        const glm::dvec3 lens = table_from_projector.translation;
        rectangle.centre_m += glm::dvec2(lens + ray * (lens.z / -ray.z) - corner);
    }
    return rectangle;
}

std::array<glm::dvec3, 4> picture_corners(const typography::TableRectangle& rectangle) {
    const std::array<glm::dvec2, 4> c = rectangle.corners(); // from the bottom left, counter-clockwise
    return flat_corners({c[3], c[2], c[1], c[0]});
}

std::array<glm::dvec3, 4> flat_corners(const std::array<glm::dvec2, 4>& corners_m) {
    std::array<glm::dvec3, 4> corners{};
    for (std::size_t k = 0; k < corners.size(); ++k) {
        corners[k] = glm::dvec3(corners_m[k], 0.0);
    }
    return corners;
}

} // namespace frustumscreen::residency
