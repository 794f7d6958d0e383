/// Imports a stick's packs into the installed set: looks at them, copies and checks them, switches to the new set
/// at once, reports.
///
/// Order    installed_set.h and library_folder.h. Nothing of a pack but the ZIP's directory is parsed before its
///          signature is checked. Whenever the import is interrupted, either the old set or the new one is
///          installed, whole.
/// Whole    a fault of a pack concerns that pack alone. A failing stick, a full disk or a refused set file concerns
///          the stick: nothing of it is taken.
/// Memory   bounded, whatever is on the stick.
/// Threads  one caller; only one import for a folder at a time (the program holds a lock).
/// Errors   in the report, each with one sentence.
#pragma once

#include "app/library/import_limits.h"
#include "app/library/import_report.h"
#include "app/pack/signed_pack.h"
#include "firmware_host/base/file_tree.h"
#include "firmware_host/base/time.h"

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen {

struct ImportRequest {
    std::string import_id;
    std::string stick;                          ///< its label
    std::vector<TrustedKey> keys;               ///< of the settings; set.txt has those that sets brought
    std::optional<std::chrono::sys_days> today; ///< used only for the last days of keys
    UnsignedPacks unsigned_packs = UnsignedPacks::Refuse;
    bool takes_settings = false;          ///< the kiosk takes its settings from sticks
    std::optional<ImportedPack> settings; ///< outcome of the stick's settings: the report's first line
    std::vector<ImportedPack> kiosk; ///< outcome of its copy of a kiosk, and a request that waits for the
                                     ///< staff: the next lines
    bool writes_reports = false;     ///< the kiosk writes a report on itself to a stick that asks for it
    std::vector<ImportedPack> stick_report; ///< outcome of that: the lines after these
    ImportLimits limits;
};

/// The import's inputs from outside, which a test replaces.
struct ImportEnvironment {
    std::function<MonotonicTime()> now;
    std::function<Nanoseconds()> work; ///< processor time of this process
    /// Gets each stage, and the progress of copying; the receiver limits the rate.
    std::function<void(const ImportReport&)> tell;
};

/// Returns the last report, which was passed to `tell` too: Done or Failed.
ImportReport import_stick(FileTree& stick, WritableTree& library, const ImportRequest& request,
                          const ImportEnvironment& environment);

} // namespace frustumscreen
