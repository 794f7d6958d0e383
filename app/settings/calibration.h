/// A calibration as it is kept: the measured projector and tracker registration, with date, method and accuracy.
/// On a kiosk it replaces the values of `[projector]` and `[tracker]`.
///
/// Form     TOML, with the keys of the settings; `version` is that of the file format.
/// Frames   table T, as everywhere (docs/conventions.md).
/// Errors   one line: file, line, key, what was found, what is allowed.
/// Threads  values; any.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/registration.h"
#include "app/geometry/transform.h"
#include "firmware_host/base/result.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace frustumscreen::settings {

/// Corners: the picture's corners at two heights, measured by hand. Touch: the prop laid on crosses. Auto: by a camera.
enum class CalibrationMethod : std::uint8_t { Corners, Touch, Auto };
[[nodiscard]] std::string_view name_of(CalibrationMethod method);

inline constexpr std::size_t largest_calibration_bytes = 65536;

struct Calibration {
    std::string made; ///< by the machine's clock: "2026-11-25 10:12 UTC"
    CalibrationMethod method = CalibrationMethod::Touch;
    int places = 0; ///< number of measured places
    /// Error at a place that was left out of the fit: on the table, and in the picture.
    double mean_mm = 0.0, worst_mm = 0.0, mean_px = 0.0;
    geometry::Pinhole pinhole;
    geometry::RigidTransform table_from_projector;
    geometry::Registration registration;
};

[[nodiscard]] std::string calibration_text(const Calibration& calibration);
/// `file` names the text in messages.
[[nodiscard]] Result<Calibration> parse_calibration(std::string_view text, const std::filesystem::path& file);

} // namespace frustumscreen::settings
