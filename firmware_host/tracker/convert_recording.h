/// Converts recordings of other trackers into our poses. Input: rows of `t x y z qx qy qz qw`, separated by
/// commas or blanks, in seconds and metres, with an optional line of column names and `#` comments. The
/// quaternion's w comes last, as in the TUM RGB-D benchmark and many motion capture exports.
///
/// Time     counted from the first row, in whole microseconds; a row whose time does not increase is dropped.
/// Frames   the recording's own. With `flat` the motion is projected onto the table: x and y relative to the
///          middle of their range, scaled down until they fit; z = 0; the rotation about Z since the first
///          row.
/// Errors   one line with the line's number.
/// Threads  pure; any.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/tracker/tracker.h"

#include <string_view>
#include <vector>

namespace frustumscreen::tracker {

struct RecordingOptions {
    int station = prop_station;
    bool flat = false;
    glm::dvec2 half_extent_m{0.17, 0.13}; ///< flat: largest distance of the prop from the table's centre
};

struct ConvertedRecording {
    std::vector<PoseSample> samples;
    int dropped_rows = 0; ///< their time did not increase
    int sign_flips = 0;   ///< times the recording's quaternions change sign; the converted ones do not
    double scale = 1.0;   ///< flat: scale of the positions
};

[[nodiscard]] Result<ConvertedRecording> convert_recording(std::string_view text, std::string_view name,
                                                           const RecordingOptions& options);

} // namespace frustumscreen::tracker
