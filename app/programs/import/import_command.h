/// What frustumscreen-import does: takes a stick's packs, lists the installed set, or says that a stick could not be mounted.
///
/// Threads  the main one.
/// Errors   what becomes of a stick, and what could not be begun, stands in its report. Of the others one line each.
#pragma once

#include "app/library/import_report.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen {

struct ImportArguments {
    std::filesystem::path from;   ///< the stick's folder
    std::filesystem::path into;   ///< the installed set's; it is made where it is missing
    std::filesystem::path keys;   ///< folder of *.pub; empty: those of `config`
    std::filesystem::path config; ///< settings; empty: none
    /// Folder of the kiosk's own kiosk.toml, which the stick's replaces (library/stick_settings.h); empty, or not there: it is left
    /// alone. What was taken is marked by a file settings-taken beside the report.
    std::filesystem::path settings;
    std::filesystem::path report; ///< file; empty: none
    std::string label;            ///< the stick's
    std::string id;               ///< of this import; empty: a new one
    double report_stands_s =
        0.0; ///< how old another import's report is at least, once it is over, before it is replaced
    bool allow_unsigned = false;
    bool json = false;
};

/// Waits until no other import works on the same folder.
[[nodiscard]] ImportReport import_from(const ImportArguments& arguments);
/// Leaves the report of a stick that could not be mounted. Nothing: the stick, or another part of it, was read after all, and
/// that report stays. Waits as the above.
[[nodiscard]] std::optional<ImportReport> tell_unmounted(const ImportArguments& arguments);
/// Leaves the last word of the import `id`, if it could not say it itself; else the report stays. `service_result`: why it ended,
/// as systemd says.
[[nodiscard]] Result<void> tell_ended(const ImportArguments& arguments, std::string_view service_result);
/// The set that an exhibit started now would show, and the keys: those that sets brought, and those of the settings where they are
/// named.
[[nodiscard]] Result<std::string> list_installed(const ImportArguments& arguments);

} // namespace frustumscreen
