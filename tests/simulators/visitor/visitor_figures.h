/// Accuracy of the visitor's eye by the camera: visits of one kind each, detected and tracked like in the
/// exhibit.
///
/// Threads  pure except for the clock; any. One seed gives the same visits with the same C++ library.
#pragma once

#include "tests/simulators/visitor/visitor_run.h"

#include <string>
#include <vector>

namespace frustumscreen::simulators {

struct VisitorFigures {
    std::string name;
    std::size_t visits = 0;
    /// Share of the frames with a visitor in which the exhibit has an eye from the camera.
    double seen = 0.0;
    double off_mm[2]{};      ///< of the eye, perpendicular to its line to the prop: median, 95th percentile
    double azimuth_deg[2]{}; ///< of its direction from the prop
    double picture_mm[2]{};  ///< of the picture on the prop, all points of all frames
    /// RMS of the picture's movement on the prop relative to the correct one, about its mean over a second.
    double jitter_mm = 0.0;
    double said = 0.0;   ///< RMS of error over the reported deviation, per axis: 1 is consistent
    double lag_ms = 0.0; ///< of a moving eye, beyond the prediction; 0: no movement
    double ms[2]{};      ///< CPU time per frame
};

[[nodiscard]] std::vector<VisitorCase> visitor_cases();
/// Cases that might cause a false detection.
[[nodiscard]] std::vector<VisitorCase> empty_cases();
[[nodiscard]] VisitorFigures measure(const VisitorCase& of, std::size_t visits, std::uint64_t seed);
/// False presence: how often per hour the exhibit detects a visitor in an empty room, and for which share of
/// the time.
struct WrongPresence {
    std::string name;
    double hours = 0.0;
    double times = 0.0; ///< per hour
    double share = 0.0;
};
[[nodiscard]] WrongPresence measure_empty(const VisitorCase& of, double minutes, std::uint64_t seed);

[[nodiscard]] std::string table_of(const std::vector<VisitorFigures>& figures);
[[nodiscard]] std::string csv_of(const std::vector<VisitorFigures>& figures);
[[nodiscard]] std::string table_of(const std::vector<WrongPresence>& figures);
[[nodiscard]] std::string csv_of(const std::vector<WrongPresence>& figures);

} // namespace frustumscreen::simulators
