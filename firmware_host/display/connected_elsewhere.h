/// What the kernel knows of all graphics cards' connectors without opening a card.
///
/// Threads  any.
/// Errors   none: what cannot be read is not connected.
/// Source   sysfs: /sys/class/drm/card1-HDMI-A-1/status is "connected", "disconnected" or "unknown".
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

/// Those to which something is connected, as "card1-HDMI-A-1", in order.
[[nodiscard]] std::vector<std::string> connected_connectors(const std::filesystem::path& folder);

/// Is one of them this card's? `card`: its path, such as "/dev/dri/card1"; `connector`: this one; empty =
/// any.
[[nodiscard]] bool has_connected(std::span<const std::string> connected, const std::filesystem::path& card,
                                 std::string_view connector);

} // namespace frustumscreen
