/// A table with known truth: touches with a technician's noise, and the error of a calibration on it.
///
/// Shares only structs with the code under test; its arithmetic is independent.
/// Frames   table T, tracker K, projector J; metres, pixels.
/// Threads  values; any. One seed gives the same numbers on every machine.
#pragma once

#include "app/calibration/calibrated_table.h"
#include "app/calibration/choose_crosses.h"
#include "app/calibration/touch.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace frustumscreen::simulators {

/// Uniform and normal numbers from a seed. The standard's distributions differ between libraries; these are
/// portable.
class SeededNumbers {
public:
    explicit SeededNumbers(std::uint64_t seed) : state_(seed) {}
    double between(double low, double high);
    double normal();
    glm::dvec3 normals() { return {normal(), normal(), normal()}; }
    glm::dquat rotation();
    std::size_t below(std::size_t count);

private:
    std::uint64_t state_;
};

struct SimulatedTable {
    calibration::CalibratedTable truth;
    glm::dquat sensor_from_prop{1.0, 0.0, 0.0, 0.0}; ///< mounting of the sensor in the prop
    double sensor_height_m = 0.0;                    ///< above the touched place, upright
};

/// A random but realistic projector above a table, and a tracker next to it: throw 0.8 to 2.5, a lens shift
/// or a fixed offset, aimed roughly at the table, distortion up to a per cent at the corner.
[[nodiscard]] SimulatedTable some_table(std::uint64_t seed);

/// A table as shipped (config/kiosk.toml), assembled by hand: the projector a few centimetres and degrees off
/// its settings, with its own zoom, lens shift and distortion; any tracker, and the sensor anywhere in the
/// prop.
[[nodiscard]] SimulatedTable shipped_table(std::uint64_t seed);

/// The pixel that a calibration lights for a point of its table's space.
[[nodiscard]] glm::dvec2 calibrated_pixel(const calibration::CalibratedTable& calibrated,
                                          const glm::dvec3& table_point);
/// The true position of a pixel's light at a height above the table.
[[nodiscard]] glm::dvec3 true_light(const calibration::CalibratedTable& truth, const glm::dvec2& pixel,
                                    double height_m);

/// A touch: the prop on a cross, upright and turned, or leaning by `lean_rad` about its own X axis.
struct PlacedProp {
    calibration::Cross cross;
    double lean_rad = 0.0;
};
[[nodiscard]] calibration::Touch simulated_touch(const SimulatedTable& table, const PlacedProp& placed,
                                                 const calibration::TouchNoise& noise,
                                                 SeededNumbers& numbers);

/// Distance between the light and its intended place, over the picture and from the table up to `top_m`: the
/// tracker gives a prop's place, the calibrated projector lights it, and the true projector shows where the
/// light is.
struct RegistrationError {
    double mean_m = 0.0;
    double worst_m = 0.0;
};
/// `reported`: the tracker's report of a sensor's pose; empty: exact.
using Reported = std::function<geometry::RigidTransform(const geometry::RigidTransform&)>;
[[nodiscard]] RegistrationError registration_error(const SimulatedTable& table,
                                                   const calibration::CalibratedTable& calibrated,
                                                   double top_m, const Reported& reported = {});
/// The offset at each place: from the intended place to the light.
[[nodiscard]] std::vector<glm::dvec3> registration_offsets(const SimulatedTable& table,
                                                           const calibration::CalibratedTable& calibrated,
                                                           double top_m, const Reported& reported = {});

} // namespace frustumscreen::simulators
