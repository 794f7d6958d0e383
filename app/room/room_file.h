/// Reads room.toml, which a designer writes: docs/room.md.
///
/// Errors   only the first, as one line: file, line, key, the value found, the values allowed.
/// Threads  pure, apart from reading the file; any.
#pragma once

#include "app/room/room.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <string_view>

namespace frustumscreen::room {

/// `file` is the name in messages; paths in the text are relative to its folder.
[[nodiscard]] Result<Room> parse_room(std::string_view text, const std::filesystem::path& file);
[[nodiscard]] Result<Room> read_room(const std::filesystem::path& file);

} // namespace frustumscreen::room
