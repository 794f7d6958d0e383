/// The known USB trackers, by vendor and product id.
#pragma once

#include "firmware_host/tracker/usb_transport.h"

#include <array>
#include <cstdint>
#include <optional>

namespace frustumscreen::tracker {

inline constexpr std::uint16_t polhemus_vendor = 0x0f44;

struct KnownTracker {
    std::uint16_t product = 0;
    UsbTrackerModel model = UsbTrackerModel::Viper;
    bool firmware_loaded = true; ///< false: id before the volatile firmware is loaded
};

inline constexpr std::array<KnownTracker, 9> known_trackers{{
    {0xbf01, UsbTrackerModel::Viper, true},
    {0xef12, UsbTrackerModel::Patriot, true},
    {0xef11, UsbTrackerModel::Patriot, false},
    {0xef20, UsbTrackerModel::Patriot, true}, // HS
    {0xef21, UsbTrackerModel::Patriot, false},
    {0xff20, UsbTrackerModel::Liberty, true}, // HS
    {0xff21, UsbTrackerModel::Liberty, false},
    {0xff12, UsbTrackerModel::Liberty, true},
    {0xff11, UsbTrackerModel::Liberty, false},
}};

[[nodiscard]] constexpr std::optional<KnownTracker> known_tracker(std::uint16_t vendor,
                                                                  std::uint16_t product) {
    if (vendor == polhemus_vendor) {
        for (const KnownTracker& known : known_trackers) {
            if (known.product == product) {
                return known;
            }
        }
    }
    return std::nullopt;
}

} // namespace frustumscreen::tracker
