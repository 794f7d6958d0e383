/// The reports of the HID tracker that anyone can build; docs/hid_tracker.md specifies every byte.
///
/// Layout   little-endian; position in units of 10 um, quaternion times 32767; each report ends with
///          CRC-16/ARC.
/// Errors   values; any bytes are safe.
/// Threads  pure functions; they allocate nothing.
#pragma once

#include "firmware_host/tracker/device_frame.h"

#include <span>
#include <variant>

namespace frustumscreen::tracker {

/// Usage of its top-level collection; vendor and product id are the maker's.
inline constexpr std::uint16_t hid_tracker_usage_page = 0xFF46;
inline constexpr std::uint16_t hid_tracker_usage = 0x53;
/// Id of the feature report, which is requested when the device is opened.
inline constexpr std::uint8_t hid_tracker_info_report = 2;
inline constexpr int hid_tracker_version = 1;

/// The feature report.
struct HidTrackerInfo {
    int version = 0;
    int position_unit_um = 0;
    int rate_hz = 0;
    int stations = 0;
};
/// The input report: a frame of one sensor. Its tick is one microsecond.
struct HidTrackerPose {
    DeviceFrame frame;
    bool starting = false;
};
using HidTrackerMessage = std::variant<DiscardReason, HidTrackerInfo, HidTrackerPose>;

/// `report` is one report, with its id first. A report of another version still gives a HidTrackerInfo,
/// whatever its other fields contain.
[[nodiscard]] HidTrackerMessage parse_hid_tracker(std::span<const std::byte> report);

} // namespace frustumscreen::tracker
