/// The reports of a 3Dconnexion SpaceMouse: the current deflection of its cap.
///
/// Layout   little-endian: report 1 is i16[3] translation, report 2 is i16[3] rotation; newer models send
///          report 1 with both, i16[6]. Full deflection is about 350. The wire's axes are right-handed: x to
///          the right, y towards the person, z down.
/// Frame    the codec converts to the table's axes: x right, y away from the person, z up.
/// Errors   values; any bytes are safe.
/// Threads  pure functions; they allocate nothing.
/// Source   public drivers. Not yet compared with a device: the axes' signs.
#pragma once

#include "firmware_host/tracker/device_frame.h"

#include <optional>
#include <span>
#include <variant>

namespace frustumscreen::tracker {

/// In counts; nullopt if the report does not contain it.
struct SpaceMouseMotion {
    std::optional<glm::dvec3> push;
    std::optional<glm::dvec3> turn;
};
/// Buttons and battery; ignored.
struct SpaceMouseOther {};
using SpaceMouseMessage = std::variant<DiscardReason, SpaceMouseOther, SpaceMouseMotion>;

/// `report` is one report, with its id first.
[[nodiscard]] SpaceMouseMessage parse_space_mouse(std::span<const std::byte> report);

} // namespace frustumscreen::tracker
