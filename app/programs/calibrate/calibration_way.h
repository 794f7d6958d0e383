/// The ways through a calibration on the table, in the order in which the buttons offer them: Back from the beginning of one goes on to the next,
/// from the last one out.
///
/// Threads  pure; any.
#pragma once

#include "firmware_host/base/result.h"

#include <optional>
#include <string>
#include <vector>

namespace frustumscreen {

enum class CalibrationWay {
    TouchUp, ///< by crosses: what moved since the kept calibration
    Camera,  ///< the whole, by a camera
    Crosses  ///< the whole, by touch
};

/// How one ended that did not end without a calibration.
enum class WayEnd {
    Kept,
    GoesOn ///< the next way is wanted
};

/// `touch_up`: a calibration is kept that it could correct; `camera`: one looks at the table, and the prop has a board for it.
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

/// An end without a calibration is an error; `problem`: why it could not be done, a half sentence, or empty.
[[nodiscard]] inline Result<WayEnd> ended_with(const std::optional<WayEnd>& end, const std::string& problem) {
    if (end) {
        return *end;
    }
    return fail(ErrorKind::BadInput, "calibrate.ended_early",
                problem.empty() ? "it ended before a calibration was kept; the previous one is still used"
                                : problem);
}

} // namespace frustumscreen
