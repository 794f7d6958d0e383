/// What the visitor's eye by the camera is worth: visits of one kind each, seen and followed as the exhibit does.
///
/// Threads  pure but for the clock; any. The same seed gives the same visits with the same C++ library.
#pragma once

#include "tests/simulators/visitor/visitor_run.h"

#include <functional>
#include <string>
#include <vector>

namespace frustumscreen {

struct VisitorFigures {
    std::string name;
    std::size_t visits = 0;
    double seen =
        0.0; ///< share of the frames with somebody there in which the exhibit has an eye by the camera
    double off_mm[2]{};      ///< of the eye across its line to the prop: median, 95th percentile
    double azimuth_deg[2]{}; ///< of its direction from the prop
    double picture_mm[2]{};  ///< of the picture on the prop, all points of all frames
    double jitter_mm =
        0.0; ///< RMS of the picture's movement on the prop about its mean of a second, against what would be right
    double said = 0.0;   ///< RMS of error by what the situation says, on each axis: 1 is honest
    double lag_ms = 0.0; ///< of the eye behind one that moves, beyond the prediction; 0: none moves
    double ms[2]{};      ///< of the processor, for a frame
};

[[nodiscard]] std::vector<VisitorCase> visitor_cases();
/// Those in which somebody might be seen who is not there.
[[nodiscard]] std::vector<VisitorCase> empty_cases();
[[nodiscard]] VisitorFigures measure(const VisitorCase& of, std::size_t visits, std::uint64_t seed);
/// Nobody is there: how often in an hour the exhibit sees somebody all the same, and for which share of the time.
struct WrongPresence {
    std::string name;
    double hours = 0.0;
    double times = 0.0; ///< an hour
    double share = 0.0;
};
[[nodiscard]] WrongPresence measure_empty(const VisitorCase& of, double minutes, std::uint64_t seed);

[[nodiscard]] std::string table_of(const std::vector<VisitorFigures>& figures);
[[nodiscard]] std::string csv_of(const std::vector<VisitorFigures>& figures);
[[nodiscard]] std::string table_of(const std::vector<WrongPresence>& figures);
[[nodiscard]] std::string csv_of(const std::vector<WrongPresence>& figures);

} // namespace frustumscreen
