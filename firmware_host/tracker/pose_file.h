/// Poses in files: CSV with the header `t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok`, `#` comments.
///
/// Frame    table T; metres; quaternions w x y z, made unit here. Times are integer microseconds.
/// Errors   one line with the line's number: what was found, what is allowed. A row with ok = 0 carries no
///          pose: its numbers may be anything that reads as a number, and it comes out at the origin.
/// Threads  pure; any.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/tracker/tracker.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

enum class PoseOrder {
    AsWritten,
    PropAscends, ///< refuse rows of station 1 whose time is not later than the one before
};

/// `name` is the file in messages. The rows in the file's order.
[[nodiscard]] Result<std::vector<PoseSample>> parse_poses(std::string_view text, std::string_view name,
                                                          PoseOrder order = PoseOrder::AsWritten);

/// Shortest decimals that read back as the same numbers.
[[nodiscard]] std::string write_poses(std::span<const PoseSample> samples);

} // namespace frustumscreen
