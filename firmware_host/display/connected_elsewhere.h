/// The kernel's knowledge of the connectors of all graphics cards, without opening a card.
///
/// Threads  any.
/// Errors   none: an unreadable connector counts as not connected.
/// Source   sysfs: /sys/class/drm/card1-HDMI-A-1/status is "connected", "disconnected" or "unknown".
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::display {

/// Sorted names of the connectors with something connected, such as "card1-HDMI-A-1".
[[nodiscard]] std::vector<std::string> connected_connectors(const std::filesystem::path& folder);

/// Whether one of them belongs to this card. `card` is its path, such as "/dev/dri/card1"; `connector` is a
/// connector's name, empty = any.
[[nodiscard]] bool has_connected(std::span<const std::string> connected, const std::filesystem::path& card,
                                 std::string_view connector);

} // namespace frustumscreen::display
