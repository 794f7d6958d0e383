/// What stands beside the drawing of the table: its places and measures in words.
///
/// Units    millimetres and degrees, as they are written.
/// Threads  pure; any.
#pragma once

#include "app/settings/lit_zone.h"
#include "app/settings/settings.h"

#include <glm/glm.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen {

/// Where the middle of a drawn prop stands: in the middle of its zone.
[[nodiscard]] glm::dvec2 drawn_place(const LitZone& zone);

/// The corners of the projector's picture on the table's plane: top left, top right, bottom right, bottom left; nothing
/// where one never meets it.
[[nodiscard]] std::optional<std::array<glm::dvec2, 4>> picture_corners(const ProjectorSettings& projector);

/// A tracker of the settings has a place.
[[nodiscard]] bool has_tracker_place(const Settings& settings);

/// Each a few lines.
struct TableNotes {
    std::vector<std::string> light, zone, eyes, lens, eye, tracker;
    std::vector<std::string> checks; ///< what to measure with a ruler
};
[[nodiscard]] TableNotes table_notes(const Settings& settings, const LitZone& zone);

} // namespace frustumscreen
