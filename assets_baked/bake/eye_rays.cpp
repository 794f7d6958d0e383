#include "assets_baked/bake/eye_rays.h"

#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustumscreen::bake {

namespace {

constexpr double eye_distance_box = 6.0;

} // namespace

std::vector<glm::dvec3> eyes_of(const ViewingZone& zone) {
    constexpr double eyes_above_the_horizon = 90.0;
    constexpr double margin_deg = 9.0;
    constexpr double golden_angle = 2.399963229728653;
    const double lowest =
        std::sin(std::max(zone.lowest_elevation_deg + margin_deg, -90.0) * std::numbers::pi / 180.0);
    std::vector<glm::dvec3> eyes(
        static_cast<std::size_t>(std::ceil(eyes_above_the_horizon * (1.0 - lowest))));
    for (std::size_t k = 0; k < eyes.size(); ++k) {
        const double z =
            lowest + (1.0 - lowest) * (static_cast<double>(k) + 0.5) / static_cast<double>(eyes.size());
        const double across = std::sqrt(1.0 - z * z);
        const double azimuth = golden_angle * static_cast<double>(k);
        eyes[k] = {across * std::cos(azimuth), across * std::sin(azimuth), z};
    }
    return eyes;
}

EyeRays::EyeRays(const glm::dvec3& towards, const glm::dvec3& box_size, double rays) {
    const glm::dvec3 centre(0.0, 0.0, box_size.z / 2.0);
    const glm::dvec3 eye = centre + eye_distance_box * towards;
    const glm::dvec3 right = glm::normalize(
        glm::cross(-towards, std::abs(towards.z) < 0.999 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 up = glm::cross(right, -towards);
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high = -low;
    for (unsigned k = 0; k < 8; ++k) {
        const glm::dvec3 corner =
            box_size *
            glm::dvec3((k & 1U) != 0 ? 0.5 : -0.5, (k & 2U) != 0 ? 0.5 : -0.5, (k & 4U) != 0 ? 1.0 : 0.0);
        const glm::dvec3 ray = corner - eye;
        const glm::dvec2 at = glm::dvec2(glm::dot(ray, right), glm::dot(ray, up)) / -glm::dot(ray, towards);
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    const glm::dvec2 extent = 1.02 * (high - low);
    step_ = std::sqrt(extent.x * extent.y / rays);
    size_ = glm::ivec2(glm::ceil(extent / step_));
    eye_ = eye;
    right_ = right * step_;
    up_ = up * step_;
    first_ = -towards + right * (0.5 * (low.x + high.x)) + up * (0.5 * (low.y + high.y)) -
             glm::dvec3(right_) * (0.5 * (size_.x - 1)) - glm::dvec3(up_) * (0.5 * (size_.y - 1));
}

double EyeRays::spacing_box() const {
    return step_ * eye_distance_box;
}

glm::vec3 EyeRays::direction(int x, int y) const {
    return glm::normalize(first_ + right_ * static_cast<float>(x) + up_ * static_cast<float>(y));
}

std::size_t EyeRays::patch(int x, int y) const {
    const int row = 4 * y / size_.y;
    const int column = 4 * x / size_.x;
    return static_cast<std::size_t>(row) * 4 + static_cast<std::size_t>(column);
}

image::Image<float> EyeRays::cast(const TraceSurface& trace) const {
    image::Image<float> distances(size_.x, size_.y, no_hit);
    parallel_for(static_cast<std::size_t>(size_.y), 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) {
            for (int x = 0; x < size_.x; ++x) {
                const SurfaceHit hit = trace(eye_, direction(x, static_cast<int>(y)));
                if (hit.hit) {
                    distances.at(x, static_cast<int>(y)) = hit.distance;
                }
            }
        }
    });
    return distances;
}

} // namespace frustumscreen::bake
