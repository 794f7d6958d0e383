#include "app/settings/stereo_parallax.h"

#include <cmath>
#include <numbers>

namespace frustumscreen::settings {

namespace {

double convergence_rad(double interocular_m, double distance_m) {
    return 2.0 * std::atan2(0.5 * interocular_m, distance_m);
}

/// The parallax along a ray from the eye towards a point; 0 if the ray passes the prop.
double parallax_rad(const geometry::PropShape& prop, const glm::dvec3& eye, const glm::dvec3& towards,
                    double interocular_m) {
    const double reach = 2.0 * glm::distance(eye, towards) + 10.0;
    const glm::dvec3 ray = glm::normalize(towards - eye);
    geometry::PropHit near;
    geometry::PropHit far; // met from behind
    if (!geometry::intersect(prop, eye, ray, near) || !geometry::enter(prop, eye + reach * ray, -ray, far)) {
        return 0.0;
    }
    return convergence_rad(interocular_m, near.t) - convergence_rad(interocular_m, reach - far.t);
}

/// The largest parallax for one eye, over points all over the box around the prop.
double largest_for_eye(const geometry::PropShape& prop, const glm::dvec3& eye, double interocular_m) {
    constexpr int steps = 12;
    glm::dvec3 half(0.0);
    for (const glm::dvec3& corner : prop.corners) {
        half = glm::max(half, glm::abs(corner - prop.middle));
    }
    double largest = 0.0;
    for (int k = 0; k < (steps + 1) * (steps + 1) * (steps + 1); ++k) {
        const glm::ivec3 node(k % (steps + 1), k / (steps + 1) % (steps + 1), k / (steps + 1) / (steps + 1));
        const glm::dvec3 share = 2.0 / steps * glm::dvec3(node) - 1.0;
        largest = std::fmax(largest, parallax_rad(prop, eye, prop.middle + share * half, interocular_m));
    }
    return largest;
}

} // namespace

double largest_parallax_rad(const Settings& settings, double distance_m) {
    constexpr int azimuths = 24;
    constexpr int elevations = 12;
    constexpr double quarter = 0.5 * std::numbers::pi;
    const geometry::PropShape prop = make_prop(settings.prop);
    const double lowest =
        settings.prop.zone == PropZone::Hand ? -quarter : glm::radians(settings.eye.lowest_elevation_deg);
    double largest = 0.0;
    for (int k = 0; k < azimuths * (elevations + 1); ++k) {
        const double azimuth = 4.0 * quarter * (k % azimuths) / azimuths;
        const double elevation = glm::mix(lowest, quarter, static_cast<double>(k / azimuths) / elevations);
        const glm::dvec3 eye =
            distance_m * glm::dvec3(std::cos(elevation) * std::cos(azimuth),
                                    std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
        largest = std::fmax(largest, largest_for_eye(prop, eye, 1e-3 * settings.eye.interocular_mm));
    }
    return largest;
}

std::optional<double> comfortable_distance_m(const Settings& settings) {
    const auto is_comfortable = [&](double distance_m) {
        return largest_parallax_rad(settings, distance_m) <= comfortable_parallax_rad;
    };
    double tiring = settings.eye.nearest_m;
    double comfortable = settings.eye.farthest_m;
    if (!is_comfortable(comfortable)) {
        return std::nullopt;
    }
    constexpr double fine_m = 0.005;
    while (comfortable - tiring > fine_m) {
        const double middle = 0.5 * (tiring + comfortable);
        (is_comfortable(middle) ? comfortable : tiring) = middle;
    }
    return comfortable;
}

} // namespace frustumscreen::settings
