/// Rests of a prop with a sheet of tags on simulated tables, and what a calibration is worth for the whole prop.
///
/// The arithmetic is its own, as in simulated_table.h.
/// Frames   the prop's: origin at the middle of its bottom, +Z up.
/// Threads  values; any.
#pragma once

#include "app/calibration/rest.h"
#include "tests/simulators/table/simulated_table.h"

namespace frustumscreen {

/// Corners of square tags, each tag's four one after the other.
using TagCorners = std::vector<glm::dvec3>;

/// Ten tags of 5 cm around the prop on a board of A3's size, on which it stands, and one on its top.
[[nodiscard]] TagCorners sheet_with_prop(double top_m = 0.12);
/// One tag of 8 cm on the prop's top.
[[nodiscard]] TagCorners tag_on_top(double top_m = 0.12);

struct RestPlan {
    int count = 16;
    int leaning = 4;      ///< of these, on a wedge of 15 to 30 degrees
    double unseen = 0.15; ///< share of the tags that the camera does not see
    std::vector<double> blocks_m{0.0, 0.04, 0.08, 0.12};
};

/// A rest of which no point is known yet, and where the prop truly is.
struct PlacedRest {
    Rest rest;
    glm::dmat4 table_from_prop{1.0};
};
/// Leaning by `lean_rad` about an axis in the table towards `towards_rad`, turned by `yaw_rad` before.
[[nodiscard]] glm::dmat4 placed_prop(const glm::dvec3& bottom, double yaw_rad, double lean_rad,
                                     double towards_rad);
/// What the tracker reports of a prop that is there, with its noise.
[[nodiscard]] RigidTransform simulated_report(const SimulatedTable& table, const glm::dmat4& table_from_prop,
                                              const RestNoise& noise, SeededNumbers& numbers);
/// Anywhere: each cell of a grid over the picture has one rest at a place of chance, turned by chance, on some block.
[[nodiscard]] std::vector<PlacedRest> placed_rests(const SimulatedTable& table, const RestPlan& plan,
                                                   const RestNoise& noise, SeededNumbers& numbers);
/// With the corners of the tags that lie in the picture and are seen; a rest without any is none.
[[nodiscard]] Rests simulated_rests(const SimulatedTable& table, const TagCorners& corners,
                                    const RestPlan& plan, const RestNoise& noise, SeededNumbers& numbers);

/// The pixel that lights a point of the table's space; nothing beside the picture.
[[nodiscard]] std::optional<glm::dvec2> true_pixel(const CalibratedTable& truth,
                                                   const glm::dvec3& table_point);

/// As registration_error, for points all over the prop: its bottom's and its top's corners too, which its turn in the sensor moves.
[[nodiscard]] RegistrationError prop_error(const SimulatedTable& table, const CalibratedTable& calibrated,
                                           const RigidTransform& sensor_from_prop, double top_m);

} // namespace frustumscreen
