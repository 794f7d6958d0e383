/// A kiosk's settings on a stick: kiosk.toml in its root and, if the kiosk has a key, its signature beside it.
///
/// Trusted   if the kiosk's settings name no key: any file. If they name keys: a file signed with one of them, with
///           a serial not lower than the highest that was taken. Keys that sets brought count for packs alone.
/// Checked   by the exhibit's own reader, before a byte is written.
/// Folder    kiosk.toml, replaced by one rename; kiosk.toml.before, what the kiosk goes back to; kiosk.toml.proved, a
///           copy that the image makes of settings with which the exhibit was lit for ten minutes; kiosk.toml.serial,
///           the highest serial taken.
/// Threads   one caller.
/// Errors    in the report's line, one sentence each; the settings stay as they are.
#pragma once

#include "app/library/import_report.h"
#include "firmware_host/base/file_tree.h"

#include <chrono>
#include <optional>
#include <string_view>

namespace frustumscreen::library {

inline constexpr std::string_view settings_file_name = "kiosk.toml";
inline constexpr std::string_view settings_before_name = "kiosk.toml.before";
inline constexpr std::string_view settings_proved_name = "kiosk.toml.proved";
inline constexpr std::string_view settings_serial_name = "kiosk.toml.serial";
inline constexpr std::size_t max_stick_settings_bytes = 64U << 10U;

/// Takes the stick's settings and returns their line; none: it has none. `folder`: the kiosk's. `today`: none: no
/// key has expired.
[[nodiscard]] std::optional<ImportedPack> take_settings(FileTree& stick, WritableTree& folder,
                                                        std::optional<std::chrono::sys_days> today);

} // namespace frustumscreen::library
