/// The objects of the room as a drawing shows them: their boxes, from their packs.
///
/// Frames   table T, metres; as the motion begins.
/// Threads  any.
/// Errors   as read_room and load_pack.
#pragma once

#include "app/drawing/drawing.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <vector>

namespace frustumscreen::programs {

/// `room`: as settings::ScreenSettings::room.
[[nodiscard]] Result<std::vector<drawing::DrawnObject>> drawn_objects(const std::filesystem::path& room);

} // namespace frustumscreen::programs
