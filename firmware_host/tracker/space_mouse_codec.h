/// The reports of a 3Dconnexion SpaceMouse: how far its cap is pushed and turned just now.
///
/// Layout   little-endian: report 1 is i16[3] translation, report 2 i16[3] rotation; newer models send report
///          1 with both, i16[6]. Full deflection is about 350. Axes of the wire, right-handed: x to the
///          right, y towards the person, z down.
/// Frame    the codec turns them into the table's: x right, y away from the person, z up.
/// Errors   values; any bytes are safe.
/// Threads  pure functions; they allocate nothing.
/// Source   public drivers. Not yet compared with a device: the axes' signs.
#pragma once

#include "firmware_host/tracker/device_frame.h"

#include <optional>
#include <span>
#include <variant>

namespace frustumscreen {

/// In counts; empty where the report says nothing.
struct SpaceMouseMotion {
    std::optional<glm::dvec3> push;
    std::optional<glm::dvec3> turn;
};
/// Buttons, battery: not used here.
struct SpaceMouseOther {};
using SpaceMouseMessage = std::variant<DiscardReason, SpaceMouseOther, SpaceMouseMotion>;

/// `report` is one report, its id in front.
[[nodiscard]] SpaceMouseMessage parse_space_mouse(std::span<const std::byte> report);

} // namespace frustumscreen
