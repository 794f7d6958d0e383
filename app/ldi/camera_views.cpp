#include "app/ldi/camera_views.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::ldi {

namespace {

/// The least of three neighbours, `step` apart, for `count` values from `first` on.
void least_of_three(float* first, std::size_t count, std::size_t step) {
    float before = first[0];
    for (std::size_t k = 0; k < count; ++k) {
        float* const here = first + k * step;
        const float own = *here;
        const float after = k + 1 < count ? here[step] : own;
        *here = std::min({before, own, after});
        before = own;
    }
}

} // namespace

CameraView::CameraView(const DepthPicture& picture)
    : camera_(picture.camera), map_(picture.camera),
      per_metre_(1.0 / glm::dot(glm::normalize(glm::cross(picture.camera.half_right, picture.camera.half_up)),
                                picture.camera.eye - picture.camera.middle)),
      nearness_(picture.nearness) {
    const auto width = static_cast<std::size_t>(camera_.width);
    const auto height = static_cast<std::size_t>(camera_.height);
    for (std::size_t y = 0; y < height; ++y) {
        least_of_three(&nearness_[y * width], width, 1);
    }
    for (std::size_t x = 0; x < width; ++x) {
        least_of_three(&nearness_[x], height, width);
    }
}

CameraView::Sight CameraView::sight(const glm::dvec3& point, double tolerance_m) const {
    const glm::dvec3 place = map_.homogeneous(point);
    if (!(place.z > 0.0) || !(place.x >= 0.0) || !(place.y >= 0.0) || !(place.x < camera_.width * place.z) ||
        !(place.y < camera_.height * place.z)) {
        return Sight::Beside;
    }
    const double per_farness = 1.0 / place.z;
    const int x = std::min(static_cast<int>(place.x * per_farness), camera_.width - 1);
    const int y = std::min(static_cast<int>(place.y * per_farness), camera_.height - 1);
    const float nearest = nearness_[static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.width) +
                                    static_cast<std::size_t>(x)];
    const double nearness = static_cast<double>(nearest) * (place.z - tolerance_m * per_metre_);
    return nearness <= 1.0 ? Sight::Seen : Sight::Hidden;
}

CameraViews::CameraViews(const TriangleWorld& world, const Hemisphere& hemisphere,
                         const glm::dvec2& half_extent_m, int width, int height)
    : world_(world), hemisphere_(hemisphere), half_extent_m_(half_extent_m), width_(width), height_(height) {}

bool CameraViews::draw_part(std::span<const std::size_t> cameras, std::size_t triangles) {
    if (drawing_ == camera_count) {
        const auto lacks = [this](std::size_t camera) { return !views_[camera]; };
        const auto next = std::find_if(cameras.begin(), cameras.end(), lacks);
        if (next == cameras.end()) {
            return false;
        }
        drawing_ = *next;
        next_triangle_ = 0;
        picture_.begin(
            camera_through_window(hemisphere_.cameras()[drawing_], half_extent_m_, width_, height_));
    }
    const std::size_t count = std::min(triangles, world_.triangle_count() - next_triangle_);
    if (next_triangle_ + count == world_.triangle_count()) {
        rasterizer_.draw(world_, picture_);
    }
    next_triangle_ += count;
    if (next_triangle_ == world_.triangle_count()) {
        views_[drawing_].emplace(picture_);
        drawing_ = camera_count;
    }
    return true;
}

std::uint64_t CameraViews::bytes() const {
    std::uint64_t bytes =
        picture_.nearness.size() * sizeof(float) + picture_.colours.size() * sizeof(glm::u8vec4);
    for (const std::optional<CameraView>& view : views_) {
        bytes += view ? view->bytes() : 0;
    }
    return bytes;
}

bool may_be_seen(const CameraViews& views, std::span<const std::size_t> cameras, const glm::dvec3& point,
                 double tolerance_m) {
    bool looks = false;
    for (const std::size_t camera : cameras) {
        const CameraView::Sight sight = views.of(camera)->sight(point, tolerance_m);
        if (sight == CameraView::Sight::Seen) {
            return true;
        }
        looks = looks || sight == CameraView::Sight::Hidden;
    }
    return !looks;
}

} // namespace frustumscreen::ldi
