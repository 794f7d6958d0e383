/// A kiosk's settings, calibration and visits as one file, kiosk.fsk, which another kiosk takes.
///
/// Bytes     a ZIP: format.txt, the line "FrustumScreen kiosk copy 1"; and what was asked for of kiosk.toml,
///           calibration.toml and a counts/DAY.json for each day. Nothing else.
/// Packs     are not in it: each is a signed file of its own.
/// Checked   settings, calibration and days by the exhibit's own readers, before any of them counts.
/// Memory    bounded before anything is unpacked.
/// Threads   pure; any.
/// Errors    one sentence: which file of the copy, what is wrong.
#pragma once

#include "app/counts/day_counts.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/result.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen {

inline constexpr std::size_t max_kiosk_copy_bytes = 4U << 20U;
inline constexpr std::size_t max_unpacked_copy_bytes = 16U << 20U; ///< of all files together

struct KioskCopy {
    std::optional<std::string> settings;    ///< kiosk.toml, every byte of it
    std::optional<std::string> calibration; ///< in the form of settings/calibration.h
    std::vector<DayCounts> days;            ///< ascending, each with its day
};

/// Equal copies give equal bytes. Errors: it has more than the limits.
[[nodiscard]] Result<Bytes> write_kiosk_copy(const KioskCopy& copy);
[[nodiscard]] Result<KioskCopy> parse_kiosk_copy(std::span<const std::byte> bytes);

} // namespace frustumscreen
