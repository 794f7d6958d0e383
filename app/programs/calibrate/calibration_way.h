/// The ways through a calibration on the table, in the order in which the buttons offer them: Back at the
/// beginning of a way goes on to the next, and leaves from the last one.
///
/// Threads  pure; any.
#pragma once

#include "firmware_host/base/result.h"

#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::programs {

enum class CalibrationWay {
    TouchUp, ///< by crosses: only what moved since the kept calibration
    Camera,  ///< a whole calibration by a camera
    Crosses  ///< a whole calibration by touch
};

/// How a way ended, unless it ended without a calibration.
enum class WayEnd {
    Kept,
    GoesOn ///< to the next way
};

/// `touch_up`: a kept calibration exists that a touch-up could correct. `camera`: a camera looks at the
/// table, and a tag sheet fits the prop.
[[nodiscard]] inline std::vector<CalibrationWay> ways_through(bool touch_up, bool camera) {
    std::vector<CalibrationWay> ways;
    if (touch_up) {
        ways.push_back(CalibrationWay::TouchUp);
    }
    if (camera) {
        ways.push_back(CalibrationWay::Camera);
    }
    ways.push_back(CalibrationWay::Crosses);
    return ways;
}

/// The way's end; an error if it ended without a calibration. `problem`: a clause on why it could not be
/// done, or empty.
[[nodiscard]] inline Result<WayEnd> ended_with(const std::optional<WayEnd>& end, const std::string& problem) {
    if (end) {
        return *end;
    }
    return fail(ErrorKind::BadInput, "calibrate.ended_early",
                problem.empty() ? "it ended before a calibration was kept; the previous one is still used"
                                : problem);
}

} // namespace frustumscreen::programs
