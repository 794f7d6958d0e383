#include "app/ldi/camera_views.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::ldi {

namespace {

/// The largest distance of an eye from the nearest camera, as a share of the eye's distance from the window: the tangent of 14.1
/// degrees (hemisphere.h).
constexpr double between_cameras = 0.25;

/// Replaces each of `count` values, `step` apart from `first` on, by the least of it and its two neighbours.
void min_of_three(float* first, std::size_t count, std::size_t step) {
    float before = first[0];
    for (std::size_t k = 0; k < count; ++k) {
        float* const here = first + k * step;
        const float own = *here;
        const float after = k + 1 < count ? here[step] : own;
        *here = std::min({before, own, after});
        before = own;
    }
}

void min_around(std::vector<float>& values, std::size_t width, std::size_t height) {
    for (std::size_t y = 0; y < height; ++y) {
        min_of_three(&values[y * width], width, 1);
    }
    for (std::size_t x = 0; x < width; ++x) {
        min_of_three(&values[x], height, width);
    }
}

} // namespace

CameraDepths::CameraDepths(const DepthPicture& picture)
    : camera_(picture.camera), map_(picture.camera),
      per_metre_(1.0 / glm::dot(glm::normalize(glm::cross(picture.camera.half_right, picture.camera.half_up)),
                                picture.camera.eye - picture.camera.middle)),
      nearness_(picture.nearness),
      shift_px_(between_cameras * glm::length(picture.camera.eye - picture.camera.middle) *
                picture.camera.width / (2.0 * glm::length(picture.camera.half_right))) {
    const auto width = static_cast<std::size_t>(camera_.width);
    const auto height = static_cast<std::size_t>(camera_.height);
    min_around(nearness_, width, height);
    for (std::size_t k = 0; k < levels_.size(); ++k) {
        Level& level = levels_[k];
        const std::size_t square = std::size_t{2} << k;
        const std::size_t columns = (width + square - 1) / square;
        const std::size_t rows = (height + square - 1) / square;
        level.columns = static_cast<int>(columns);
        level.rows = static_cast<int>(rows);
        level.nearness.assign(columns * rows, std::numeric_limits<float>::infinity());
        for (std::size_t y = 0; y < height; ++y) {
            for (std::size_t x = 0; x < width; ++x) {
                float& least = level.nearness[y / square * columns + x / square];
                least = std::min(least, nearness_[y * width + x]);
            }
        }
        min_around(level.nearness, columns, rows);
    }
}

float CameraDepths::farthest(int x, int y, double around_px) const {
    for (std::size_t k = 0; k < levels_.size(); ++k) {
        if (around_px <= static_cast<double>(2U << k) || k + 1 == levels_.size()) {
            const int square = 2 << k;
            const auto row = static_cast<std::size_t>(y / square),
                       column = static_cast<std::size_t>(x / square);
            return levels_[k].nearness[row * static_cast<std::size_t>(levels_[k].columns) + column];
        }
    }
    return 0.0F;
}

CameraDepths::Sight CameraDepths::sight(const glm::dvec3& point, double tolerance_m) const {
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
    const double farness = place.z - tolerance_m * per_metre_;
    if (static_cast<double>(nearest) * farness <= 1.0) {
        return Sight::Seen;
    }
    const double beside_px = shift_px_ * (static_cast<double>(nearest) - per_farness);
    return static_cast<double>(farthest(x, y, beside_px)) * farness <= 1.0 ? Sight::Seen : Sight::Hidden;
}

CameraDepths::Sight CameraDepths::sight_between(const glm::dvec3& from, const glm::dvec3& to,
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
    if (!(middle.x >= 0.0) || !(middle.y >= 0.0) || !(middle.x < camera_.width) ||
        !(middle.y < camera_.height)) {
        return Sight::Seen;
    }
    const auto x = static_cast<int>(middle.x);
    const auto y = static_cast<int>(middle.y);
    const float nearest = nearness_[static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.width) +
                                    static_cast<std::size_t>(x)];
    const double beside_px =
        0.5 * std::max(high.x - low.x, high.y - low.y) +
        shift_px_ * std::max(0.0, static_cast<double>(nearest) - 1.0 / std::max(a.z, b.z));
    return static_cast<double>(farthest(x, y, beside_px)) * (std::min(a.z, b.z) - tolerance_m * per_metre_) <=
                   1.0
               ? Sight::Seen
               : Sight::Hidden;
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
    for (const std::optional<CameraDepths>& view : views_) {
        bytes += view ? view->bytes() : 0;
    }
    return bytes;
}

bool may_be_seen(const CameraViews& views, std::span<const std::size_t> cameras, const glm::dvec3& point,
                 double tolerance_m) {
    bool looks = false;
    for (const std::size_t camera : cameras) {
        const CameraDepths::Sight sight = views.of(camera)->sight(point, tolerance_m);
        if (sight == CameraDepths::Sight::Seen) {
            return true;
        }
        looks = looks || sight == CameraDepths::Sight::Hidden;
    }
    return !looks;
}

bool may_be_seen_between(const CameraViews& views, std::span<const std::size_t> cameras,
                         const glm::dvec3& from, const glm::dvec3& to, double tolerance_m) {
    bool looks = false;
    for (const std::size_t camera : cameras) {
        const CameraDepths::Sight sight = views.of(camera)->sight_between(from, to, tolerance_m);
        if (sight == CameraDepths::Sight::Seen) {
            return true;
        }
        looks = looks || sight == CameraDepths::Sight::Hidden;
    }
    return !looks;
}

} // namespace frustumscreen::ldi
