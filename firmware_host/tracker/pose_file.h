/// Poses in CSV files with the header `t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok` and `#` comments.
///
/// Frame    table T; metres; quaternions w x y z, normalised here. Times are integer microseconds.
/// Errors   one line with the line's number, the value found and the allowed values. A row with ok = 0
///          carries no pose: its fields may be any numbers, and its sample is at the origin.
/// Threads  pure; any.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/tracker/tracker.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::tracker {

enum class PoseOrder {
    AsWritten,
    PropAscends, ///< refuse a row of station 1 whose time does not increase
};

/// Returns the rows in the file's order. `name` names the file in messages.
[[nodiscard]] Result<std::vector<PoseSample>> parse_poses(std::string_view text, std::string_view name,
                                                          PoseOrder order = PoseOrder::AsWritten);

/// Shortest decimals that read back as the same numbers.
[[nodiscard]] std::string write_poses(std::span<const PoseSample> samples);

} // namespace frustumscreen::tracker
