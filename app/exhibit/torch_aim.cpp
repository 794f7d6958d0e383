#include "app/exhibit/torch_aim.h"

#include "app/geometry/time_curves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace frustumscreen::exhibit {

namespace {

/// The spot fades out as the beam's far edge comes up to this angle above the table, and as its middle goes so far.
constexpr double min_descent_rad = 0.05, faint_descent_rad = 0.20;
constexpr double bright_m = 0.8, dark_m = 1.6;

double half_angle(const torch::Beam& beam) {
    const glm::dvec2 extent = torch::half_extent(beam);
    return std::atan(std::max(extent.x, extent.y));
}

glm::dvec3 direction_of(const geometry::RigidTransform& table_from_torch) {
    return table_from_torch.direction({0.0, 0.0, 1.0});
}

} // namespace

LitObject around(std::span<const glm::dvec3> points) {
    if (points.empty()) {
        return {};
    }
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high(-low);
    for (const glm::dvec3& point : points) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    LitObject object{.centre_m = 0.5 * (low + high), .radius_m = 0.0};
    for (const glm::dvec3& point : points) {
        object.radius_m = std::fmax(object.radius_m, glm::distance(point, object.centre_m));
    }
    return object;
}

TorchAim aim_of(const torch::Beam& beam, const geometry::RigidTransform& table_from_torch,
                const LitObject& object) {
    const glm::dvec3 to = object.centre_m - table_from_torch.translation;
    const double distance_m = glm::length(to);
    if (distance_m <= object.radius_m) {
        return TorchAim::Lights;
    }
    const glm::dvec3 along = direction_of(table_from_torch);
    const double off = std::atan2(glm::length(glm::cross(along, to)), glm::dot(along, to));
    if (off > half_angle(beam) + std::asin(object.radius_m / distance_m)) {
        return TorchAim::Past;
    }
    return distance_m - object.radius_m > torch::reach_m(beam) ? TorchAim::TooFar : TorchAim::Lights;
}

std::optional<TorchAim> TorchAdvice::step(MonotonicTime now, const std::optional<TorchAim>& aim) {
    if (!aim || *aim == TorchAim::Lights) {
        since_.reset();
        return std::nullopt;
    }
    since_ = since_ ? since_ : now;
    return now - *since_ >= dwell ? aim : std::nullopt;
}

std::array<glm::dvec2, 4> TorchSpot::corners() const {
    const glm::dvec2 up = half_along_m * along;
    const glm::dvec2 right = half_across_m * glm::dvec2(along.y, -along.x);
    return {centre_m + up - right, centre_m + up + right, centre_m - up + right, centre_m - up - right};
}

std::optional<TorchSpot> spot_on_table(const torch::Beam& beam,
                                       const geometry::RigidTransform& table_from_torch) {
    const glm::dvec3 along = direction_of(table_from_torch);
    const double height = table_from_torch.translation.z;
    const double descent = std::asin(std::clamp(-along.z, -1.0, 1.0));
    const double half = half_angle(beam);
    const double far_edge = descent - half; // angle at which the beam's far edge comes down
    if (height <= 0.0 || far_edge <= min_descent_rad) {
        return std::nullopt;
    }
    // From the point below the torch to the ellipse's ends; the near end may lie behind that point.
    const double far = height / std::tan(far_edge);
    const double near = height / std::tan(descent + half);
    TorchSpot spot;
    const glm::dvec2 flat(along);
    spot.along = glm::length(flat) > 1e-9 ? glm::normalize(flat) : glm::dvec2(0.0, 1.0);
    spot.centre_m = glm::dvec2(table_from_torch.translation) + 0.5 * (far + near) * spot.along;
    spot.half_along_m = 0.5 * (far - near);
    // A plane cuts the cone in an ellipse of this eccentricity.
    const double eccentricity = std::cos(descent) / std::cos(half);
    spot.half_across_m = spot.half_along_m * std::sqrt(std::fmax(0.0, 1.0 - eccentricity * eccentricity));
    const double distance_m = height / std::sin(descent);
    spot.share = geometry::ease((far_edge - min_descent_rad) / (faint_descent_rad - min_descent_rad)) *
                 (1.0 - geometry::ease((distance_m - bright_m) / (dark_m - bright_m)));
    return spot;
}

} // namespace frustumscreen::exhibit
