/// Fields shared by several of the bench's tables.
///
/// Threads  pure; any.
#pragma once

#include "app/bench/truth/poses.h"

#include <string>

namespace frustumscreen::bench {

/// A field that may contain commas, quoted as in RFC 4180.
[[nodiscard]] std::string quoted(const std::string& text);

/// Position of the prop and the eye, in table coordinates; the prop's rotation about the vertical as a
/// quaternion.
inline constexpr const char* pose_columns = "px_m,py_m,qw,qz,eye_x_m,eye_y_m,eye_z_m";
[[nodiscard]] std::string pose_fields(const BenchPose& pose);

} // namespace frustumscreen::bench
