/// The notes next to the drawing of the table: positions and measures in words.
///
/// Units    in words: millimetres and degrees; functions: metres in the table frame T.
/// Threads  pure; any.
#pragma once

#include "app/settings/lit_zone.h"
#include "app/settings/settings.h"

#include <glm/glm.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::drawing {

/// Middle of the drawn prop: in the middle of its zone.
[[nodiscard]] glm::dvec2 drawn_place(const settings::LitZone& zone);

/// The corners of the projector's picture on the table's plane: top left, top right, bottom right, bottom
/// left; nullopt if one never meets it.
[[nodiscard]] std::optional<std::array<glm::dvec2, 4>>
picture_corners(const settings::ProjectorSettings& projector);

/// Whether the tracker of the settings has a position.
[[nodiscard]] bool has_tracker_place(const settings::Settings& settings);

/// A few lines each.
struct TableNotes {
    std::vector<std::string> light, zone, eyes, lens, eye, tracker;
    std::vector<std::string> checks; ///< measures to check with a ruler
};
[[nodiscard]] TableNotes table_notes(const settings::Settings& settings, const settings::LitZone& zone);

} // namespace frustumscreen::drawing
