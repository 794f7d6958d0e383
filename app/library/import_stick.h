/// A stick's packs into the installed set: looked at, copied, checked, switched to at once, told.
///
/// Order    installed_set.h and library_folder.h; nothing of a pack is parsed before its signature was right, but the ZIP's
///          directory. Whatever happens and whenever it ends, the old set or the new one is installed, whole.
/// Whole    what a pack is refused for concerns that pack; a stick that fails, a full disk, or a set file that is refused
///          concern the stick: nothing of it is taken.
/// Memory   bounded, whatever the stick holds.
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
    std::string stick;            ///< its label
    std::vector<TrustedKey> keys; ///< of the settings; those that sets brought come from set.txt
    std::optional<std::chrono::sys_days> today; ///< for the ends of keys alone
    UnsignedPacks unsigned_packs = UnsignedPacks::Refuse;
    bool takes_settings = false;          ///< the kiosk takes its settings from sticks
    std::optional<ImportedPack> settings; ///< what became of the stick's settings: the report's first line
    ImportLimits limits;
};

/// What the import asks of the outside, so that a test is that outside.
struct ImportSurroundings {
    std::function<MonotonicTime()> now;
    std::function<Nanoseconds()> work; ///< processor time of this process
    /// Hears each stage, and how far copying is; the receiver thins it out.
    std::function<void(const ImportReport&)> tell;
};

/// The last report, which was told too: Done or Failed.
ImportReport import_stick(FileTree& stick, WritableTree& library, const ImportRequest& request,
                          const ImportSurroundings& surroundings);

} // namespace frustumscreen
