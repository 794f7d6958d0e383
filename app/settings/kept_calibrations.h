/// The calibrations of a kiosk, as files of one folder: the newest one counts, and the two before it are there to go back to.
///
/// Names    calibration-0008.toml; numbers grow. One that was undone is calibration-0008.undone until the next one is kept.
/// Order    a new one appears by one rename, before an old one goes: at each moment the newest whole one is that of before or
///          the new one (FileTree's order of syncs).
/// Errors   one line: which file, what, what to do.
/// Threads  one caller.
#pragma once

#include "app/settings/calibration.h"
#include "firmware_host/base/file_tree.h"

#include <string>
#include <vector>

namespace frustumscreen {

inline constexpr std::size_t most_kept_calibrations = 3;

struct KeptCalibration {
    int number = 0;
    std::string name; ///< of the file in the folder
};

/// The newest first. What else lies in the folder is passed over.
[[nodiscard]] Result<std::vector<KeptCalibration>> list_calibrations(FileTree& folder);
[[nodiscard]] Result<Calibration> read_calibration(FileTree& folder, const KeptCalibration& kept);
/// It is the newest one, and on the disk, when this returns.
[[nodiscard]] Result<KeptCalibration> keep_calibration(WritableTree& folder, const Calibration& calibration);
/// The one before the newest counts again. Returns which one was undone. Errors: there is none.
[[nodiscard]] Result<KeptCalibration> undo_calibration(WritableTree& folder);

} // namespace frustumscreen
