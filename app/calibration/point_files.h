/// Touches, rests, sightings and corners in files: CSV with a header; `#` begins a comment.
///
/// Touches  tx_m,ty_m,tz_m,qw,qx,qy,qz,u_px,v_px,block_m
/// Rests    rest,tx_m,ty_m,tz_m,qw,qx,qy,qz,x_m,y_m,z_m,u_px,v_px,block_m: a row for each point, which
///          repeats its rest's number, pose and block; block_m is empty if the prop leans
/// Sights   eye,tx_m,ty_m,tz_m,qw,qx,qy,qz,u_px,v_px,x_m,y_m,z_m: left or right, the pose of the head's
///          sensor, the cross's pixel, and the prop's place that covers the cross, in the table's frame
/// Corners  distance,corner,x_m,y_m,z_m
/// Errors   one sentence with file and line, also for a quaternion that is no rotation; other quaternions are
///          normalised. All other numbers are returned unchecked: the calibration judges them.
/// Threads  pure; any.
#pragma once

#include "app/calibration/corners.h"
#include "app/calibration/eye_sight.h"
#include "app/calibration/rest.h"
#include "app/calibration/touch.h"
#include "firmware_host/base/result.h"

#include <span>
#include <string>
#include <string_view>

namespace frustumscreen::calibration {

/// `name`: of the file, for messages.
[[nodiscard]] Result<Touches> parse_touches(std::string_view text, std::string_view name);
/// The text that parse_touches reads.
[[nodiscard]] std::string touches_text(std::span<const Touch> touches);
[[nodiscard]] Result<Rests> parse_rests(std::string_view text, std::string_view name);
/// The text that parse_rests reads.
[[nodiscard]] std::string rests_text(std::span<const Rest> rests);
/// The text that parse_sights reads.
[[nodiscard]] std::string sights_text(std::span<const ReportedSight> sights);
[[nodiscard]] Result<ReportedSights> parse_sights(std::string_view text, std::string_view name);
[[nodiscard]] Result<std::vector<MeasuredCorner>> parse_corners(std::string_view text, std::string_view name);

} // namespace frustumscreen::calibration
