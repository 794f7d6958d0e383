/// Touches and corners in files: CSV with a header, `#` begins a comment.
///
/// Touches  tx_m,ty_m,tz_m,qw,qx,qy,qz,u_px,v_px,block_m
/// Rests    rest,tx_m,ty_m,tz_m,qw,qx,qy,qz,x_m,y_m,z_m,u_px,v_px,block_m: a row for each point, in which its rest's number, place and block stand
///          again; block_m is empty where the prop leans
/// Sights   eye,tx_m,ty_m,tz_m,qw,qx,qy,qz,u_px,v_px,x_m,y_m,z_m: left or right, the head's sensor, the cross's pixel, and in the table's frame
///          the place of the prop that covers it
/// Corners  distance,corner,x_m,y_m,z_m
/// Errors   one sentence with file and line, also of a quaternion that is no rotation; those that are get length 1. Other numbers are taken as they
///          stand: whether they make sense is the calibration's to say.
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

namespace frustumscreen {

/// `name` stands in messages.
[[nodiscard]] Result<Touches> parse_touches(std::string_view text, std::string_view name);
/// What parse_touches reads.
[[nodiscard]] std::string touches_text(std::span<const Touch> touches);
[[nodiscard]] Result<Rests> parse_rests(std::string_view text, std::string_view name);
/// What parse_rests reads.
[[nodiscard]] std::string rests_text(std::span<const Rest> rests);
/// What parse_sights reads.
[[nodiscard]] std::string sights_text(std::span<const ReportedSight> sights);
[[nodiscard]] Result<ReportedSights> parse_sights(std::string_view text, std::string_view name);
[[nodiscard]] Result<std::vector<MeasuredCorner>> parse_corners(std::string_view text, std::string_view name);

} // namespace frustumscreen
