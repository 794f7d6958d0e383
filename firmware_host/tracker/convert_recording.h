/// Converts recordings of other trackers into our poses: rows of `t x y z qx qy qz qw`, separated by commas
/// or blanks (the form of the TUM RGB-D benchmark and of many motion capture exports), seconds and metres,
/// the quaternion's w last, `#` comments, an optional line of column names.
///
/// Time     counted from the first row, whole microseconds; rows that do not step forward are dropped.
/// Frames   the recording's own; with `flat` the motion is laid onto the table: x and y about the middle of
///          their range, shrunk until they fit, z = 0, and the turn about Z since the first row.
/// Errors   one line with the line's number.
/// Threads  pure; any.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/tracker/tracker.h"

#include <optional>
#include <string_view>
#include <vector>

namespace frustumscreen {

struct RecordingOptions {
    int station = prop_station;
    bool flat = false;
    glm::dvec2 half_extent_m{0.17, 0.13}; ///< flat: where the prop may be, about the table's centre
};

struct ConvertedRecording {
    std::vector<PoseSample> samples;
    int dropped_rows = 0; ///< whose time did not go forward
    int sign_flips = 0;   ///< times the recording's quaternions change sign; the converted ones do not
    double scale = 1.0;   ///< flat: of the positions
};

[[nodiscard]] Result<ConvertedRecording> convert_recording(std::string_view text, std::string_view name,
                                                           const RecordingOptions& options);

} // namespace frustumscreen
