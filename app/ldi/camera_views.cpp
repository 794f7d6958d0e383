#include "app/ldi/camera_views.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::ldi {

namespace {

constexpr int coarse_px = 16;

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
      nearness_(picture.nearness), coarse_columns_((picture.camera.width + coarse_px - 1) / coarse_px),
      coarse_rows_((picture.camera.height + coarse_px - 1) / coarse_px),
      coarse_(static_cast<std::size_t>(coarse_columns_) * static_cast<std::size_t>(coarse_rows_),
              std::numeric_limits<float>::infinity()) {
    const auto width = static_cast<std::size_t>(camera_.width);
    const auto height = static_cast<std::size_t>(camera_.height);
    for (std::size_t y = 0; y < height; ++y) {
        least_of_three(&nearness_[y * width], width, 1);
    }
    for (std::size_t x = 0; x < width; ++x) {
        least_of_three(&nearness_[x], height, width);
    }
    const auto columns = static_cast<std::size_t>(coarse_columns_);
    for (std::size_t y = 0; y < height; ++y) {
        for (std::size_t x = 0; x < width; ++x) {
            float& coarse = coarse_[y / coarse_px * columns + x / coarse_px];
            coarse = std::min(coarse, nearness_[y * width + x]);
        }
    }
    for (std::size_t y = 0; y < static_cast<std::size_t>(coarse_rows_); ++y) {
        least_of_three(&coarse_[y * columns], columns, 1);
    }
    for (std::size_t x = 0; x < columns; ++x) {
        least_of_three(&coarse_[x], static_cast<std::size_t>(coarse_rows_), columns);
    }
}

CameraView::Sight CameraView::sight_between(const glm::dvec3& from, const glm::dvec3& to,
                                            double tolerance_m) const {
    const glm::dvec3 a = map_.homogeneous(from);
    const glm::dvec3 b = map_.homogeneous(to);
    if (!(a.z > 0.0) || !(b.z > 0.0)) {
        return Sight::Seen;
    }
    const glm::dvec2 at = glm::dvec2(a) / a.z;
    const glm::dvec2 end = glm::dvec2(b) / b.z;
    constexpr double around = 4.0; // pixels
    const glm::dvec2 low = glm::min(at, end) - around;
    const glm::dvec2 high = glm::max(at, end) + around;
    if (high.x < 0.0 || high.y < 0.0 || low.x > camera_.width || low.y > camera_.height) {
        return Sight::Beside;
    }
    const glm::dvec2 middle = 0.5 * (at + end);
    if (high.x - low.x > 2 * coarse_px || high.y - low.y > 2 * coarse_px || !(middle.x >= 0.0) ||
        !(middle.y >= 0.0) || !(middle.x < camera_.width) || !(middle.y < camera_.height)) {
        return Sight::Seen;
    }
    const float nearest = coarse_[static_cast<std::size_t>(static_cast<int>(middle.y) / coarse_px) *
                                      static_cast<std::size_t>(coarse_columns_) +
                                  static_cast<std::size_t>(static_cast<int>(middle.x) / coarse_px)];
    return static_cast<double>(nearest) * (std::min(a.z, b.z) - tolerance_m * per_metre_) <= 1.0
               ? Sight::Seen
               : Sight::Hidden;
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
        rasterizer_.begin_depths(world_, picture_);
        return true;
    }
    const std::size_t count = std::min(triangles, world_.triangle_count() - next_triangle_);
    rasterizer_.draw_depths(world_, picture_, next_triangle_, count);
    next_triangle_ += count;
    if (next_triangle_ == world_.triangle_count()) {
        views_[drawing_].emplace(picture_);
        drawing_ = camera_count;
    }
    return true;
}

std::uint64_t CameraViews::bytes() const {
    std::uint64_t bytes = picture_.nearness.size() * sizeof(float) +
                          picture_.colours.size() * sizeof(glm::u8vec4) + rasterizer_.bytes();
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

bool may_be_seen_between(const CameraViews& views, std::span<const std::size_t> cameras,
                         const glm::dvec3& from, const glm::dvec3& to, double tolerance_m) {
    bool looks = false;
    for (const std::size_t camera : cameras) {
        const CameraView::Sight sight = views.of(camera)->sight_between(from, to, tolerance_m);
        if (sight == CameraView::Sight::Seen) {
            return true;
        }
        looks = looks || sight == CameraView::Sight::Hidden;
    }
    return !looks;
}

} // namespace frustumscreen::ldi
