/// Takes the copy of a kiosk from a stick: kiosk.fsk in its root, with its signature kiosk.fsk.minisig beside it.
///
/// Trusted   as settings of a stick (library/own_settings.h): a kiosk whose settings name no key takes any copy, as a new
///           disk does; else a signature with one of its keys counts, and its serial is not lower than the highest taken.
/// Checked   as a whole, before a byte is written.
/// Order     visits, calibration, settings: whenever it is interrupted, each of them is the old or the new one, and the
///           same stick is taken again. Settings and calibration of before are kept as if a stick's settings were taken,
///           or the table were measured.
/// Visits    a day that the kiosk has numbers of stays as it is, and so do today and later days, which the exhibit writes.
/// Threads   one caller.
/// Errors    in the line, one sentence.
#pragma once

#include "app/library/import_report.h"
#include "firmware_host/base/file_tree.h"

#include <chrono>
#include <filesystem>
#include <optional>

namespace frustumscreen {

struct KioskFolders {
    WritableTree& settings;
    WritableTree& calibration;
    std::filesystem::path counts;
};

/// None: the stick has no copy. `today`: none: no key has expired.
[[nodiscard]] std::optional<ImportedPack> take_kiosk_copy(FileTree& stick, const KioskFolders& kiosk,
                                                          std::optional<std::chrono::sys_days> today);

} // namespace frustumscreen
