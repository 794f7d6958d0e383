/// The work of frustumscreen-import: takes a stick's packs, lists the installed set, or reports that a stick cannot be
/// mounted.
///
/// Threads  the main one.
/// Errors   the outcome of a stick, and an import that could not begin, are in its report. Other errors are one line
///          each.
#pragma once

#include "app/library/import_report.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen::programs {

struct ImportArguments {
    std::filesystem::path from;   ///< the stick's folder
    std::filesystem::path into;   ///< folder of the installed set; made if missing
    std::filesystem::path keys;   ///< folder of *.pub; empty: those of `config`
    std::filesystem::path config; ///< settings; empty: none
    /// Folder of the kiosk's own kiosk.toml, which the stick's replaces (library/stick_settings.h); empty or missing:
    /// no settings are taken. A file settings-taken beside the report marks that they were taken.
    std::filesystem::path settings;
    /// Folders of the kiosk's calibrations and visits: with `settings`, a stick's copy of a kiosk is taken too
    /// (kiosk_copy/take_kiosk_copy.h). Empty: none is.
    std::filesystem::path calibration, counts;
    std::filesystem::path report; ///< file; empty: none
    /// File with the outcome of the report that another program wrote to the stick; it is removed. Empty: this kiosk
    /// writes none. A file copy-asked beside the report names the import whose stick waits for the staff's buttons.
    std::filesystem::path stick_report;
    std::string label;            ///< label of the stick
    std::string id;               ///< id of this import; empty: a new one
    double report_stands_s = 0.0; ///< least age of another import's finished report before it is replaced
    bool allow_unsigned = false;
    bool confirmed = false; ///< the staff have confirmed a copy onto this stick; it was written before
    bool json = false;
};

/// Waits until no other import uses the folder.
[[nodiscard]] library::ImportReport import_from(const ImportArguments& arguments);
/// Reports that a stick could not be mounted. Nothing if the stick, or another partition of it, was read after all: its
/// report stays. Waits as import_from.
[[nodiscard]] std::optional<library::ImportReport> tell_unmounted(const ImportArguments& arguments);
/// Writes the final report of the import `id` if that ended without one; else the report stays. `service_result`:
/// reason for the end, in systemd's words.
[[nodiscard]] Result<void> tell_ended(const ImportArguments& arguments, std::string_view service_result);
/// Lists the set that an exhibit started now would show, and the keys: those brought by sets, and those of the settings
/// if settings are named.
[[nodiscard]] Result<std::string> list_installed(const ImportArguments& arguments);

} // namespace frustumscreen::programs
