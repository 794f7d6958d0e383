#include "app/visitor/head_fit.h"

#include <Eigen/Dense>
#include <cmath>
#include <vector>

namespace frustumscreen::visitor {

namespace {

constexpr double height_of_width = 1.3;
/// Breadth of a head with hair, from in front: mean, and spread of its logarithm (people, hair).
constexpr double usual_width_m = 0.172;
constexpr double width_log_sd = 0.10;
/// Distance of a visitor's head centre from the table's edge: people lean on the table, or stand a step away.
constexpr double usual_outside_m = 0.17;
constexpr double outside_sd_m = 0.10;
constexpr double not_at_table = 0.1; ///< probability that a head is anywhere
constexpr double worst_fit = 0.09;   ///< RMS distance from the ellipse, relative to its half width
/// Error that an outline does not show: unusual hair, a tilted head.
constexpr double hidden_sd_m = 0.012;

/// An upright image plane in front of the camera, at distance 1 along `forward`.
struct View {
    glm::dvec3 forward{0.0}, right{0.0}, up{0.0};

    View(const glm::dvec3& towards) : forward(glm::normalize(towards)) {
        right = glm::normalize(glm::cross(forward, glm::dvec3(0, 0, 1)));
        up = glm::cross(right, forward);
    }
    [[nodiscard]] glm::dvec2 place(const glm::dvec3& ray) const {
        return glm::dvec2(glm::dot(ray, right), glm::dot(ray, up)) / glm::dot(ray, forward);
    }
    [[nodiscard]] glm::dvec3 ray(const glm::dvec2& place) const {
        return glm::normalize(forward + place.x * right + place.y * up);
    }
};

struct Ellipse {
    glm::dvec2 middle{0.0};
    double half_width = 0.0;
    double fit = 0.0; ///< RMS distance of the points, relative to its half width
};

/// Fits the ellipse. Residual of a point, relative to the ellipse's size: |((x - x0) / a, (y - y0) / (h a))|
/// - 1.
Ellipse fitted(const std::vector<glm::dvec2>& points, Ellipse ellipse) {
    constexpr int steps = 8;
    constexpr double far_off = 0.05; // a larger residual has less weight
    for (int step = 0; step < steps; ++step) {
        Eigen::Matrix3d normal = Eigen::Matrix3d::Identity() * 1e-9;
        Eigen::Vector3d right = Eigen::Vector3d::Zero();
        double squares = 0.0;
        for (const glm::dvec2& point : points) {
            const double a = ellipse.half_width;
            const glm::dvec2 at = (point - ellipse.middle) / (a * glm::dvec2(1.0, height_of_width));
            const double length = std::fmax(1e-6, glm::length(at));
            const double off = length - 1.0;
            const double weight = std::abs(off) < far_off ? 1.0 : far_off / std::abs(off);
            const Eigen::Vector3d slope(-at.x / (length * a), -at.y / (length * a * height_of_width),
                                        -length / a);
            normal += weight * slope * slope.transpose();
            right -= weight * slope * off;
            squares += std::fmin(off * off, far_off * std::abs(off));
        }
        const Eigen::Vector3d change = normal.ldlt().solve(right);
        ellipse.middle += glm::dvec2(change.x(), change.y());
        ellipse.half_width = std::fmax(0.5 * ellipse.half_width, ellipse.half_width + change.z());
        ellipse.fit = std::sqrt(squares / static_cast<double>(points.size()));
    }
    return ellipse;
}

struct Distance {
    double mean_m = 0.0, sd_m = 0.0;
    bool at_table = false;
};

/// Distance of the head along its ray: the mean over all distances, weighted by the probabilities of that
/// width and that place.
Distance distance_along(const glm::dvec3& origin, const glm::dvec3& ray, double half_width,
                        const HeadZone& zone) {
    double total = 0.0, sum = 0.0, squares = 0.0;
    constexpr double step_m = 0.02;
    constexpr double farthest_m = 5.0;
    for (double away = step_m; away < farthest_m; away += step_m) {
        const double wide = std::log(2.0 * half_width * away / usual_width_m) / width_log_sd;
        const double outside = (zone.outside_m(origin + away * ray) - usual_outside_m) / outside_sd_m;
        const double weight = std::exp(-0.5 * wide * wide) *
                              (not_at_table + (1.0 - not_at_table) * std::exp(-0.5 * outside * outside));
        total += weight;
        sum += weight * away;
        squares += weight * away * away;
    }
    if (!(total > 0.0)) {
        return {};
    }
    const double mean = sum / total;
    return {mean, std::sqrt(std::fmax(0.0, squares / total - mean * mean)), zone.holds(origin + mean * ray)};
}

} // namespace

std::optional<FittedHead> fit_head(const HeadOutline& outline, const geometry::Pinhole& camera,
                                   const geometry::RigidTransform& table_from_camera, const HeadZone& zone) {
    glm::dvec2 first(0.0);
    for (const glm::dvec2& point : outline.edge) {
        first += point / static_cast<double>(outline.edge.size());
    }
    const auto ray_of = [&](const glm::dvec2& pixel) {
        return table_from_camera.direction(camera.ray(pixel));
    };
    const View view(ray_of(first));
    std::vector<glm::dvec2> points;
    for (const glm::dvec2& pixel : outline.edge) {
        points.push_back(view.place(ray_of(pixel)));
    }
    const double half_width =
        0.5 * glm::distance(view.place(ray_of(first - glm::dvec2(0.5 * outline.width, 0.0))),
                            view.place(ray_of(first + glm::dvec2(0.5 * outline.width, 0.0))));
    const Ellipse ellipse = fitted(points, {glm::dvec2(0.0), half_width});
    const bool is_one = ellipse.fit < worst_fit && ellipse.half_width < 1.6 * half_width &&
                        glm::length(ellipse.middle) < 2.0 * half_width;
    if (!is_one) { // also true for NaN
        return std::nullopt;
    }
    const glm::dvec3 ray = view.ray(ellipse.middle);
    const Distance distance = distance_along(table_from_camera.translation, ray, ellipse.half_width, zone);
    const std::optional<glm::dvec2> pixel = camera.pixel(table_from_camera.inverse().direction(ray));
    if (!distance.at_table || !pixel) {
        return std::nullopt;
    }
    return FittedHead{.middle_m = table_from_camera.translation + distance.mean_m * ray,
                      .across_sd_m = hidden_sd_m,
                      .along_sd_m = distance.sd_m,
                      .pixel = *pixel,
                      .width_px = outline.width};
}

} // namespace frustumscreen::visitor
