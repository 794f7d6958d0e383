/// Rests of a prop with a sheet of tags on simulated tables, and the error of a calibration over the whole
/// prop.
///
/// Shares no arithmetic with the code under test, as in simulated_table.h.
/// Frames   the prop's: origin at the middle of its bottom, +Z up.
/// Threads  values; any.
#pragma once

#include "app/calibration/rest.h"
#include "tests/simulators/table/simulated_table.h"

namespace frustumscreen::simulators {

/// Corners of square tags, four per tag, tag by tag.
using TagCorners = std::vector<glm::dvec3>;

/// Ten tags of 5 cm around the prop on an A3 tag sheet under it, and one on its top.
[[nodiscard]] TagCorners sheet_with_prop(double top_m = 0.12);
/// One tag of 8 cm on the prop's top.
[[nodiscard]] TagCorners tag_on_top(double top_m = 0.12);

struct RestPlan {
    int count = 16;
    int leaning = 4;      ///< how many of these stand on a wedge of 15 to 30 degrees
    double unseen = 0.15; ///< share of the tags that the camera does not see
    std::vector<double> blocks_m{0.0, 0.04, 0.08, 0.12};
};

/// A rest without decoded points, and the prop's true pose.
struct PlacedRest {
    calibration::Rest rest;
    glm::dmat4 table_from_prop{1.0};
};
/// Turned by `yaw_rad`, then leaning by `lean_rad` about an axis in the table towards `towards_rad`.
[[nodiscard]] glm::dmat4 placed_prop(const glm::dvec3& bottom, double yaw_rad, double lean_rad,
                                     double towards_rad);
/// The tracker's report for a prop at this pose, with its noise.
[[nodiscard]] geometry::RigidTransform simulated_report(const SimulatedTable& table,
                                                        const glm::dmat4& table_from_prop,
                                                        const calibration::RestNoise& noise,
                                                        SeededNumbers& numbers);
/// Random poses: each cell of a grid over the picture has one rest at a random place, randomly turned, on
/// some board.
[[nodiscard]] std::vector<PlacedRest> placed_rests(const SimulatedTable& table, const RestPlan& plan,
                                                   const calibration::RestNoise& noise,
                                                   SeededNumbers& numbers);
/// Rests with the corners of the tags that are in the picture and visible; skips rests without any.
[[nodiscard]] calibration::Rests simulated_rests(const SimulatedTable& table, const TagCorners& corners,
                                                 const RestPlan& plan, const calibration::RestNoise& noise,
                                                 SeededNumbers& numbers);

/// The pixel that lights a point in table space; nullopt outside the picture.
[[nodiscard]] std::optional<glm::dvec2> true_pixel(const calibration::CalibratedTable& truth,
                                                   const glm::dvec3& table_point);

/// Like registration_error, but for points all over the prop: also the corners of its bottom and top, which
/// move with its rotation in the sensor's frame.
[[nodiscard]] RegistrationError prop_error(const SimulatedTable& table,
                                           const calibration::CalibratedTable& calibrated,
                                           const geometry::RigidTransform& sensor_from_prop, double top_m);

} // namespace frustumscreen::simulators
