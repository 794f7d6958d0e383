/// A kiosk's calibrations, as files in one folder. The newest one counts; the two before it are kept to go back to.
///
/// Names    calibration-0008.toml; numbers grow. An undone one is calibration-0008.undone until the next one is
///          kept.
/// Order    a new one appears by one rename, before an old one is removed: at each moment the newest whole file is
///          the previous one or the new one (FileTree's order of syncs).
/// Errors   one line: which file, what, what to do.
/// Threads  one caller.
#pragma once

#include "app/settings/calibration.h"
#include "firmware_host/base/file_tree.h"

#include <string>
#include <vector>

namespace frustumscreen::settings {

inline constexpr std::size_t max_kept_calibrations = 3;

struct KeptCalibration {
    int number = 0;
    std::string name; ///< of the file in the folder
};

/// The newest first. Other files in the folder are ignored.
[[nodiscard]] Result<std::vector<KeptCalibration>> list_calibrations(FileTree& folder);
[[nodiscard]] Result<Calibration> read_calibration(FileTree& folder, const KeptCalibration& kept);
/// On return, the calibration is the newest one, and on the disk.
[[nodiscard]] Result<KeptCalibration> keep_calibration(WritableTree& folder, const Calibration& calibration);
/// Makes the one before the newest count again. Returns the undone one. Errors: there is none.
[[nodiscard]] Result<KeptCalibration> undo_calibration(WritableTree& folder);

} // namespace frustumscreen::settings
