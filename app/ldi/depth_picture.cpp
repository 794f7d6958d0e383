#include "app/ldi/depth_picture.h"

#include <cassert>
#include <cmath>

namespace frustumscreen::ldi {

PictureCamera camera_through_window(const glm::dvec3& eye, const glm::dvec2& half_extent_m, int width,
                                    int height) {
    return {eye, glm::dvec3(0.0), {half_extent_m.x, 0.0, 0.0}, {0.0, half_extent_m.y, 0.0}, width, height};
}

PictureMap::PictureMap(const PictureCamera& camera) : eye_(camera.eye) {
    const double right2 = glm::dot(camera.half_right, camera.half_right);
    const double up2 = glm::dot(camera.half_up, camera.half_up);
    if (!(right2 > 0.0 && up2 > 0.0) || !std::isfinite(right2 + up2) || camera.width < 1 ||
        camera.height < 1 || camera.width > max_picture_side || camera.height > max_picture_side) {
        return;
    }
    const glm::dvec3 normal = glm::normalize(glm::cross(camera.half_right, camera.half_up));
    const double distance = glm::dot(normal, camera.eye - camera.middle);
    if (!(distance > 0.0) || !std::isfinite(distance) || !std::isfinite(1.0 / distance)) {
        return;
    }
    per_column_ = 2.0 * camera.half_right / static_cast<double>(camera.width);
    per_row_ = -2.0 * camera.half_up / static_cast<double>(camera.height);
    to_corner_ = camera.middle - camera.half_right + camera.half_up - camera.eye;
    toward_plane_ = -normal / distance;
    columns_ = per_column_ / glm::dot(per_column_, per_column_);
    rows_ = per_row_ / glm::dot(per_row_, per_row_);
    first_column_ = -glm::dot(columns_, to_corner_);
    first_row_ = -glm::dot(rows_, to_corner_);
    usable_ = std::isfinite(glm::dot(toward_plane_, toward_plane_)) && std::isfinite(first_column_) &&
              std::isfinite(first_row_) &&
              std::isfinite(glm::dot(columns_, columns_) + glm::dot(rows_, rows_));
}

std::optional<PictureMap::Place> PictureMap::project(const glm::dvec3& point) const {
    const glm::dvec3 place = homogeneous(point);
    if (!usable_ || !(place.z > 0.0)) {
        return std::nullopt;
    }
    const double nearness = 1.0 / place.z;
    if (!std::isfinite(nearness)) {
        return std::nullopt;
    }
    return Place{place.x * nearness, place.y * nearness, nearness};
}

void DepthPicture::begin(const PictureCamera& of) {
    assert(of.width >= 0 && of.width <= max_picture_side && of.height >= 0 && of.height <= max_picture_side);
    camera = of;
    nearness.assign(of.pixel_count(), 0.0F);
    colours.assign(of.pixel_count(), glm::u8vec4(0));
}

} // namespace frustumscreen::ldi
