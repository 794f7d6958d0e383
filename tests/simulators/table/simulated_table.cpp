#include "tests/simulators/table/simulated_table.h"

#include <array>
#include <cmath>
#include <numbers>

namespace frustumscreen::simulators {

namespace {

constexpr double pi = std::numbers::pi;

/// Inverts the distortion by bisection: slow, and independent of the solver's own method.
double unbent(double goal, const geometry::Lens& lens) {
    double low = 0.0;
    double high = 3.0;
    for (int k = 0; k < 70; ++k) {
        const double r = 0.5 * (low + high);
        const double slope = 1.0 + 3.0 * lens.k1 * r * r + 5.0 * lens.k2 * r * r * r * r;
        const double bent = r * (1.0 + lens.k1 * r * r + lens.k2 * r * r * r * r);
        (slope > 0.0 && bent < goal ? low : high) = r;
    }
    return 0.5 * (low + high);
}

glm::dquat about_z(double angle) {
    return {std::cos(0.5 * angle), 0.0, 0.0, std::sin(0.5 * angle)};
}

/// The sensor's pose for a prop whose touched place is at a point in table space.
geometry::RigidTransform sensor_at(const SimulatedTable& table, const glm::dvec3& table_point, double yaw,
                                   double lean) {
    const glm::dquat table_from_prop =
        about_z(yaw) * glm::dquat(std::cos(0.5 * lean), std::sin(0.5 * lean), 0.0, 0.0);
    const geometry::RigidTransform tracker_from_table = table.truth.table_from_tracker.inverse();
    geometry::RigidTransform tracker_from_sensor;
    tracker_from_sensor.rotation =
        tracker_from_table.rotation * table_from_prop * glm::conjugate(table.sensor_from_prop);
    tracker_from_sensor.translation =
        tracker_from_table.point(table_point) - tracker_from_sensor.rotation * table.truth.sensor_offset_m;
    return tracker_from_sensor;
}

glm::dquat small_turn(const glm::dvec3& v) {
    const double angle = glm::length(v);
    return angle > 0.0 ? glm::angleAxis(angle, v / angle) : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

/// A projector that looks down, any tracker beside the table, the sensor anywhere in the prop.
SimulatedTable table_under(const geometry::Pinhole& pinhole, const glm::dvec3& lens_m,
                           const glm::dvec3& off_rad, const glm::dvec2& sensor_heights_m,
                           SeededNumbers& numbers) {
    SimulatedTable table;
    calibration::CalibratedTable& truth = table.truth;
    truth.pinhole = pinhole;
    const glm::dquat down(0.0, 1.0, 0.0, 0.0);
    truth.table_from_projector = {glm::normalize(down * small_turn(off_rad)), lens_m};
    // Applies the convention of the table's frame, whatever the aim.
    calibration::TouchModel model;
    model.pinhole = truth.pinhole;
    model.projector_from_tracker = truth.table_from_projector.inverse();
    truth.table_from_projector = calibration::in_table_frame(model)->table_from_projector;
    truth.table_from_tracker = {
        numbers.rotation(),
        {numbers.between(-0.6, 0.6), numbers.between(-0.6, 0.6), numbers.between(-0.3, 0.4)}};
    table.sensor_height_m = numbers.between(sensor_heights_m.x, sensor_heights_m.y);
    table.sensor_from_prop = numbers.rotation();
    const glm::dvec3 in_prop{numbers.between(-0.02, 0.02), numbers.between(-0.02, 0.02),
                             table.sensor_height_m};
    truth.sensor_offset_m = table.sensor_from_prop * -in_prop;
    return table;
}

/// Distortion up to `share` at the picture's corner.
geometry::Lens some_lens(double share, int width, int height, double throw_ratio, SeededNumbers& numbers) {
    const double sides = static_cast<double>(height) / width;
    const double corner2 = (0.25 + 0.25 * sides * sides) / (throw_ratio * throw_ratio);
    return {std::fmax(-0.1, std::fmin(0.1, numbers.between(-share, share) / corner2)), 0.0};
}

} // namespace

glm::dvec2 calibrated_pixel(const calibration::CalibratedTable& calibrated, const glm::dvec3& table_point) {
    const glm::dvec3 q(glm::inverse(calibrated.table_from_projector.matrix()) * glm::dvec4(table_point, 1.0));
    const double x = q.x / q.z;
    const double y = q.y / q.z;
    const double r2 = x * x + y * y;
    const double factor = 1.0 + calibrated.pinhole.lens.k1 * r2 + calibrated.pinhole.lens.k2 * r2 * r2;
    return {calibrated.pinhole.fx * x * factor + calibrated.pinhole.cx,
            calibrated.pinhole.fy * y * factor + calibrated.pinhole.cy};
}

glm::dvec3 true_light(const calibration::CalibratedTable& truth, const glm::dvec2& pixel, double height_m) {
    const geometry::Pinhole& p = truth.pinhole;
    const glm::dvec2 real((pixel.x - p.cx) / p.fx, (pixel.y - p.cy) / p.fy);
    const double r = glm::length(real);
    const glm::dvec2 ideal = r > 0.0 ? real * (unbent(r, truth.pinhole.lens) / r) : real;
    const glm::dmat4 table_from_projector = truth.table_from_projector.matrix();
    const glm::dvec3 lens(table_from_projector[3]);
    const glm::dvec3 ray(table_from_projector * glm::dvec4(ideal, 1.0, 0.0));
    return lens + ray * ((height_m - lens.z) / ray.z);
}

double SeededNumbers::between(double low, double high) {
    state_ += 0x9E3779B97F4A7C15U; // splitmix64
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    z ^= z >> 31U;
    return low + (high - low) * (static_cast<double>(z >> 11U) * 0x1p-53);
}

double SeededNumbers::normal() {
    const double r = std::sqrt(-2.0 * std::log(between(0x1p-53, 1.0)));
    return r * std::cos(2.0 * pi * between(0.0, 1.0));
}

glm::dquat SeededNumbers::rotation() {
    const double a = normal();
    const double b = normal();
    const double c = normal();
    return glm::normalize(glm::dquat(normal(), a, b, c));
}

std::size_t SeededNumbers::below(std::size_t count) {
    return static_cast<std::size_t>(between(0.0, static_cast<double>(count)));
}

SimulatedTable some_table(std::uint64_t seed) {
    SeededNumbers numbers(seed);
    constexpr std::array<glm::ivec2, 4> sizes{{{1920, 1200}, {1920, 1080}, {1280, 800}, {3840, 2160}}};
    const glm::ivec2 size = sizes[numbers.below(sizes.size())];
    const double width = size.x;
    const double throw_ratio = numbers.between(0.8, 2.5);
    const double table_width_m = numbers.between(0.7, 1.1);
    const double shift =
        numbers.between(0.0, 1.0) < 0.5 ? numbers.between(-0.1, 0.1) : numbers.between(0.3, 0.6);
    const double fx = throw_ratio * width;
    geometry::Pinhole pinhole{size.x,
                              size.y,
                              fx,
                              fx * std::exp(5e-4 * numbers.normal()),
                              (0.5 + numbers.between(-0.03, 0.03)) * width,
                              (0.5 + shift) * size.y};
    pinhole.lens = some_lens(0.01, size.x, size.y, throw_ratio, numbers); // some per mille to a per cent
    // Aimed at the table's middle within some degrees.
    const glm::dvec3 off{numbers.between(-0.15, 0.15), numbers.between(-0.15, 0.15),
                         numbers.between(-0.05, 0.05)};
    return table_under(pinhole, {0.0, 0.0, throw_ratio * table_width_m}, off, {0.03, 0.09}, numbers);
}

SimulatedTable shipped_table(std::uint64_t seed) {
    SeededNumbers numbers(seed);
    constexpr int width = 1920;
    constexpr int height = 1200;
    const double throw_ratio = 1.875 * numbers.between(0.98, 1.02);
    const double fx = throw_ratio * width;
    geometry::Pinhole pinhole{width,
                              height,
                              fx,
                              fx * std::exp(5e-4 * numbers.normal()),
                              (0.5 + numbers.between(-0.02, 0.02)) * width,
                              (0.5 + numbers.between(-0.02, 0.02)) * height};
    pinhole.lens = some_lens(0.01, width, height, throw_ratio, numbers);
    const glm::dvec3 off{numbers.between(-0.03, 0.03), numbers.between(-0.03, 0.03),
                         numbers.between(-0.02, 0.02)};
    return table_under(pinhole, {0.0, 0.0, numbers.between(1.48, 1.52)}, off, {0.08, 0.09}, numbers);
}

calibration::Touch simulated_touch(const SimulatedTable& table, const PlacedProp& placed,
                                   const calibration::TouchNoise& noise, SeededNumbers& numbers) {
    const calibration::Cross& cross = placed.cross;
    const glm::dvec2 laid = cross.pixel + noise.pixel * glm::dvec2{numbers.normal(), numbers.normal()};
    const double height = cross.block_m + noise.block_m * numbers.normal();
    const geometry::RigidTransform pose =
        sensor_at(table, true_light(table.truth, laid, height), cross.yaw_rad, placed.lean_rad);
    calibration::Touch touch;
    touch.tracker_from_sensor.translation = pose.translation + noise.position_m * numbers.normals();
    touch.tracker_from_sensor.rotation =
        glm::normalize(small_turn(noise.rotation_rad * numbers.normals()) * pose.rotation);
    touch.pixel = cross.pixel;
    touch.block_m = cross.block_m;
    return touch;
}

std::vector<glm::dvec3> registration_offsets(const SimulatedTable& table,
                                             const calibration::CalibratedTable& calibrated, double top_m,
                                             const Reported& reported) {
    std::vector<glm::dvec3> offsets;
    for (int level = 0; level <= 2; ++level) {
        const double height = 0.5 * level * top_m;
        for (int row = 0; row <= 6; ++row) {
            for (int column = 0; column <= 8; ++column) {
                const glm::dvec2 pixel(table.truth.pinhole.width * column / 8.0,
                                       table.truth.pinhole.height * row / 6.0);
                const glm::dvec3 place = true_light(table.truth, pixel, height);
                for (int quarter = 0; quarter < 4; ++quarter) {
                    geometry::RigidTransform pose = sensor_at(table, place, 0.5 * pi * quarter, 0.0);
                    pose = reported ? reported(pose) : pose;
                    const glm::dvec3 believed = calibrated.table_from_tracker.point(
                        pose.translation + pose.rotation * calibrated.sensor_offset_m);
                    offsets.push_back(
                        true_light(table.truth, calibrated_pixel(calibrated, believed), height) - place);
                }
            }
        }
    }
    return offsets;
}

RegistrationError registration_error(const SimulatedTable& table,
                                     const calibration::CalibratedTable& calibrated, double top_m,
                                     const Reported& reported) {
    const std::vector<glm::dvec3> offsets = registration_offsets(table, calibrated, top_m, reported);
    RegistrationError error;
    for (const glm::dvec3& offset : offsets) {
        const double off = glm::length(offset);
        error.mean_m += off / static_cast<double>(offsets.size());
        error.worst_m = std::fmax(error.worst_m, off);
    }
    return error;
}

} // namespace frustumscreen::simulators
