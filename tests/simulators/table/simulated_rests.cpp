#include "tests/simulators/table/simulated_rests.h"

#include <array>
#include <cmath>
#include <numbers>

namespace frustumscreen::simulators {

namespace {

constexpr double pi = std::numbers::pi;

void add_tag(TagCorners& corners, const glm::dvec3& middle, double size) {
    for (const glm::dvec2& side : std::array<glm::dvec2, 4>{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}) {
        corners.push_back(middle + 0.5 * size * glm::dvec3(side, 0.0));
    }
}

} // namespace

glm::dmat4 placed_prop(const glm::dvec3& bottom, double yaw_rad, double lean_rad, double towards_rad) {
    const glm::dvec3 axis(std::cos(towards_rad), std::sin(towards_rad), 0.0);
    glm::dmat4 matrix =
        glm::mat4_cast(glm::angleAxis(lean_rad, axis) * glm::angleAxis(yaw_rad, glm::dvec3(0.0, 0.0, 1.0)));
    matrix[3] = glm::dvec4(bottom, 1.0);
    return matrix;
}

geometry::RigidTransform simulated_report(const SimulatedTable& table, const glm::dmat4& table_from_prop,
                                          const calibration::RestNoise& noise, SeededNumbers& numbers) {
    glm::dmat4 sensor_from_prop = glm::mat4_cast(table.sensor_from_prop);
    sensor_from_prop[3] = glm::dvec4(table.truth.sensor_offset_m, 1.0);
    const glm::dmat4 tracker_from_sensor = glm::inverse(table.truth.table_from_tracker.matrix()) *
                                           table_from_prop * glm::inverse(sensor_from_prop);
    geometry::RigidTransform report;
    report.translation = glm::dvec3(tracker_from_sensor[3]) + noise.position_m * numbers.normals();
    const glm::dvec3 turn = noise.rotation_rad * numbers.normals();
    const double angle = glm::length(turn);
    const glm::dquat off = angle > 0.0 ? glm::angleAxis(angle, turn / angle) : glm::dquat(1.0, 0.0, 0.0, 0.0);
    report.rotation = glm::normalize(off * glm::quat_cast(glm::dmat3(tracker_from_sensor)));
    return report;
}

TagCorners sheet_with_prop(double top_m) {
    TagCorners corners;
    for (const double y : {-0.115, 0.0, 0.115}) {
        for (const double x : {-0.175, -0.0583, 0.0583, 0.175}) {
            if (y != 0.0 || std::abs(x) > 0.1) {
                add_tag(corners, {x, y, 0.0}, 0.05);
            }
        }
    }
    add_tag(corners, {0.0, 0.0, top_m}, 0.06);
    return corners;
}

TagCorners tag_on_top(double top_m) {
    TagCorners corners;
    add_tag(corners, {0.0, 0.0, top_m}, 0.08);
    return corners;
}

std::optional<glm::dvec2> true_pixel(const calibration::CalibratedTable& truth,
                                     const glm::dvec3& table_point) {
    const glm::dvec2 pixel = calibrated_pixel(truth, table_point);
    const bool inside =
        pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x <= truth.pinhole.width && pixel.y <= truth.pinhole.height;
    return inside ? std::optional(pixel) : std::nullopt;
}

std::vector<PlacedRest> placed_rests(const SimulatedTable& table, const RestPlan& plan,
                                     const calibration::RestNoise& noise, SeededNumbers& numbers) {
    const int columns = static_cast<int>(std::ceil(std::sqrt(1.5 * plan.count)));
    const int rows = (plan.count + columns - 1) / columns;
    const glm::dvec2 size(table.truth.pinhole.width, table.truth.pinhole.height);
    std::vector<PlacedRest> rests;
    for (int k = 0; k < plan.count; ++k) {
        const bool leans = k * plan.leaning / plan.count != (k + 1) * plan.leaning / plan.count;
        const double block = plan.blocks_m[numbers.below(plan.blocks_m.size())];
        const glm::dvec2 cell((k % columns + numbers.between(0.1, 0.9)) / columns,
                              (k / columns + numbers.between(0.1, 0.9)) / rows);
        const glm::dvec3 light = true_light(table.truth, (0.04 + 0.92 * cell) * size, block);
        const double lean = leans ? numbers.between(0.26, 0.52) : 0.0;
        const glm::dvec3 raised(0.0, 0.0, leans ? 0.05 : noise.block_m * numbers.normal());
        PlacedRest rest;
        rest.table_from_prop =
            placed_prop(light + raised, numbers.between(0.0, 2.0 * pi), lean, numbers.between(0.0, 2.0 * pi));
        rest.rest.name = k + 1;
        rest.rest.tracker_from_sensor = simulated_report(table, rest.table_from_prop, noise, numbers);
        rest.rest.block_m = leans ? std::nullopt : std::optional(block);
        rests.push_back(std::move(rest));
    }
    return rests;
}

calibration::Rests simulated_rests(const SimulatedTable& table, const TagCorners& corners,
                                   const RestPlan& plan, const calibration::RestNoise& noise,
                                   SeededNumbers& numbers) {
    const glm::dvec2 size(table.truth.pinhole.width, table.truth.pinhole.height);
    calibration::Rests rests;
    for (const PlacedRest& place : placed_rests(table, plan, noise, numbers)) {
        calibration::Rest rest = place.rest;
        for (std::size_t tag = 0; tag < corners.size(); tag += 4) {
            std::vector<calibration::PropPoint> found;
            for (std::size_t j = tag; j < tag + 4; ++j) {
                const auto pixel =
                    true_pixel(table.truth, glm::dvec3(place.table_from_prop * glm::dvec4(corners[j], 1.0)));
                const glm::dvec2 off = noise.pixel * glm::dvec2{numbers.normal(), numbers.normal()};
                if (pixel) {
                    found.push_back({corners[j], glm::clamp(*pixel + off, glm::dvec2(0.0), size)});
                }
            }
            if (found.size() == 4 && numbers.between(0.0, 1.0) >= plan.unseen) {
                rest.points.insert(rest.points.end(), found.begin(), found.end());
            }
        }
        if (!rest.points.empty()) {
            rests.push_back(std::move(rest));
        }
    }
    return rests;
}

RegistrationError prop_error(const SimulatedTable& table, const calibration::CalibratedTable& calibrated,
                             const geometry::RigidTransform& sensor_from_prop, double top_m) {
    const double base = 0.15;
    const double top = 0.04;
    std::vector<glm::dvec3> points;
    for (const glm::dvec2& side : std::array<glm::dvec2, 4>{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}) {
        points.emplace_back(base * side, 0.0);
        points.emplace_back(top * side, top_m);
    }
    SeededNumbers none(1);
    RegistrationError error;
    int count = 0;
    for (int k = 0; k < 35 * 4; ++k) {
        const glm::dvec2 pixel(table.truth.pinhole.width * (k / 4 % 7) / 6.0,
                               table.truth.pinhole.height * (k / 28) / 4.0);
        const glm::dmat4 table_from_prop =
            placed_prop(true_light(table.truth, pixel, 0.0), 0.5 * pi * (k % 4), 0.0, 0.0);
        const geometry::RigidTransform report =
            simulated_report(table, table_from_prop, {0.0, 0.0, 0.0, 0.0}, none);
        for (const glm::dvec3& point : points) {
            const glm::dvec3 place(table_from_prop * glm::dvec4(point, 1.0));
            if (!true_pixel(table.truth, place)) {
                continue;
            }
            const glm::dvec3 believed =
                calibrated.table_from_tracker.point(report.point(sensor_from_prop.point(point)));
            const double off = glm::distance(
                true_light(table.truth, calibrated_pixel(calibrated, believed), place.z), place);
            error.mean_m += off;
            error.worst_m = std::fmax(error.worst_m, off);
            ++count;
        }
    }
    error.mean_m /= count;
    return error;
}

} // namespace frustumscreen::simulators
