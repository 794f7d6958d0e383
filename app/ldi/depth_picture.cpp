#include "app/ldi/depth_picture.h"

#include <cassert>
#include <cmath>

namespace frustumscreen::ldi {

PictureCamera camera_through_window(const glm::dvec3& eye, const glm::dvec2& half_extent_m, int width,
                                    int height) {
    return {eye, glm::dvec3(0.0), {half_extent_m.x, 0.0, 0.0}, {0.0, half_extent_m.y, 0.0}, width, height};
}

namespace {

constexpr double max_coordinate_m = 1e9;
constexpr double min_distance_share = 1e-6; ///< of the rectangle's size

bool within_reach(const glm::dvec3& point) {
    return std::fabs(point.x) <= max_coordinate_m && std::fabs(point.y) <= max_coordinate_m &&
           std::fabs(point.z) <= max_coordinate_m;
}
/// True if the value is above 0, and its square and the inverse of that are finite.
bool has_length(double length) {
    return length > 1.0 / max_coordinate_m && length < max_coordinate_m;
}

} // namespace

PictureMap::PictureMap(const PictureCamera& camera) : eye_(camera.eye) {
    const double half_width = glm::length(camera.half_right);
    const double half_height = glm::length(camera.half_up);
    if (!has_length(half_width) || !has_length(half_height) || !within_reach(camera.eye) ||
        !within_reach(camera.middle) || camera.width < 1 || camera.height < 1 ||
        camera.width > max_picture_side || camera.height > max_picture_side) {
        return;
    }
    const glm::dvec3 normal = glm::cross(camera.half_right / half_width, camera.half_up / half_height);
    const double distance = glm::dot(normal, camera.eye - camera.middle);
    if (!(distance > min_distance_share * std::fmax(half_width, half_height))) {
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
    usable_ = true;
}

std::optional<PictureMap::Place> PictureMap::project(const glm::dvec3& point) const {
    const glm::dvec3 place = homogeneous(point);
    if (!usable_ || !(place.z >= min_farness && std::isfinite(place.z))) {
        return std::nullopt;
    }
    const double nearness = 1.0 / place.z;
    return Place{place.x * nearness, place.y * nearness, nearness};
}

void DepthPicture::begin(const PictureCamera& of) {
    assert(of.width >= 0 && of.width <= max_picture_side && of.height >= 0 && of.height <= max_picture_side);
    camera = of;
    nearness.assign(of.pixel_count(), 0.0F);
    colours.assign(of.pixel_count(), glm::u8vec4(0));
}

} // namespace frustumscreen::ldi
