/// How known HID trackers are recognised: ours by the usage of its collection, a SpaceMouse by vendor and
/// usage.
#pragma once

#include "firmware_host/tracker/hid_tracker_codec.h"
#include "firmware_host/tracker/usb_transport.h"

#include <optional>

namespace frustumscreen::tracker {

inline constexpr std::uint16_t space_mouse_vendor = 0x256f;
/// Older models have the parent company's vendor id, and products 0xc6xx.
inline constexpr std::uint16_t old_space_mouse_vendor = 0x046d;
inline constexpr unsigned old_space_mouse_products = 0xc6;
inline constexpr std::uint16_t desktop_usage_page = 0x01;
inline constexpr std::uint16_t multi_axis_usage = 0x08;

struct HidIdentity {
    std::uint16_t vendor = 0;
    std::uint16_t product = 0;
    std::uint16_t usage_page = 0; ///< of the top-level collection
    std::uint16_t usage = 0;
};

[[nodiscard]] constexpr std::optional<UsbTrackerModel> known_hid_tracker(const HidIdentity& device) {
    if (device.usage_page == hid_tracker_usage_page && device.usage == hid_tracker_usage) {
        return UsbTrackerModel::Hid;
    }
    const bool theirs = device.vendor == space_mouse_vendor ||
                        (device.vendor == old_space_mouse_vendor &&
                         (static_cast<unsigned>(device.product) >> 8U) == old_space_mouse_products);
    if (theirs && device.usage_page == desktop_usage_page && device.usage == multi_axis_usage) {
        return UsbTrackerModel::SpaceMouse;
    }
    return std::nullopt;
}

} // namespace frustumscreen::tracker
