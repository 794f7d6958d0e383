/// A kiosk's settings on a stick: kiosk.toml in its root, and where the kiosk knows a key, its signature beside it.
///
/// Believed  while the kiosk's settings name no key: anybody's. Once they name one: those that are signed with one of the keys
///           that the settings name, with a serial that is not lower than the highest that was taken. Keys that sets brought are
///           for packs alone.
/// Checked   by the reader that the exhibit has, before a byte is written.
/// Folder    kiosk.toml, replaced by one rename; kiosk.toml.before, what it was; kiosk.toml.serial, the highest serial.
/// Threads   one caller.
/// Errors    in the line, each with one sentence; the settings are what they were.
#pragma once

#include "app/library/import_report.h"
#include "firmware_host/base/file_tree.h"

#include <chrono>
#include <optional>
#include <string_view>

namespace frustumscreen {

inline constexpr std::string_view settings_file_name = "kiosk.toml";
inline constexpr std::string_view settings_before_name = "kiosk.toml.before";
inline constexpr std::string_view settings_serial_name = "kiosk.toml.serial";
inline constexpr std::size_t most_stick_settings_bytes = 64U << 10U;

/// What became of the stick's settings; nothing: it has none. `folder`: of the kiosk's own. `today`: none: no key has ended.
[[nodiscard]] std::optional<ImportedPack> take_settings(FileTree& stick, WritableTree& folder,
                                                        std::optional<std::chrono::sys_days> today);

} // namespace frustumscreen
