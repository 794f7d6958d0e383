/// What frustumscreen-import does: takes a stick's packs, lists the installed set, or says that a stick could not be mounted.
///
/// Threads  the main one.
/// Errors   one line each: what could not be begun. What becomes of a stick stands in its report.
#pragma once

#include "app/library/import_report.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace frustumscreen {

struct ImportArguments {
    std::filesystem::path from;   ///< the stick's folder
    std::filesystem::path into;   ///< the installed set's; it is made where it is missing
    std::filesystem::path keys;   ///< folder of *.pub; empty: those of `config`
    std::filesystem::path config; ///< settings; empty: none
    std::filesystem::path report; ///< file; empty: none
    std::string label;            ///< the stick's
    std::string id;               ///< of this import; empty: a new one
    bool allow_unsigned = false;
    bool json = false;
};

/// Waits until no other import works on the same folder.
[[nodiscard]] Result<ImportReport> import_from(const ImportArguments& arguments);
/// Leaves the report of a stick whose file system could not be mounted.
[[nodiscard]] Result<ImportReport> tell_unmounted(const ImportArguments& arguments);
/// Leaves the last word of the import `id`, if it could not say it itself; else the report stays. `service_result`: why it ended,
/// as systemd says.
[[nodiscard]] Result<void> tell_ended(const ImportArguments& arguments, std::string_view service_result);
/// The set that an exhibit started now would show, as text.
[[nodiscard]] Result<std::string> list_installed(const ImportArguments& arguments);

} // namespace frustumscreen
