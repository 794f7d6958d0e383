/// What the kernel knows about the connectors of all graphics cards, without opening a card.
///
/// Threads  any.
/// Errors   none: what cannot be read counts as not connected.
/// Source   sysfs: /sys/class/drm/card1-HDMI-A-1/status is "connected", "disconnected" or "unknown".
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

/// Names of the connectors with something connected, such as "card1-HDMI-A-1", in order.
[[nodiscard]] std::vector<std::string> connected_connectors(const std::filesystem::path& folder);

/// Does one of them belong to this card? `card`: its path, such as "/dev/dri/card1"; `connector`: its name,
/// empty = any.
[[nodiscard]] bool has_connected(std::span<const std::string> connected, const std::filesystem::path& card,
                                 std::string_view connector);

} // namespace frustumscreen
