/// The volume that the staff chose with the buttons, relative to the settings' volume; kept over restarts in a file
/// of one line.
///
///     louder_db 3 over 0
///
/// Rule     valid as long as the settings' own volume (`sound.gain_db`) is the one relative to which it was chosen.
///          Settings with another volume take precedence, and the next choice begins from theirs.
/// Units    decibels.
/// Threads  the keeper has one caller, which writes files.
/// Errors   a file that cannot be read or written counts as missing.
#pragma once

#include <filesystem>

namespace frustumscreen::show {

/// 0: no volume was chosen relative to `settings_gain_db`.
[[nodiscard]] int read_kept_volume(const std::filesystem::path& file, double settings_gain_db);

class VolumeKeeper {
public:
    VolumeKeeper(std::filesystem::path file, double settings_gain_db);
    /// Writes the file if the volume differs from the kept one.
    void note(int louder_db);

private:
    std::filesystem::path file_;
    double settings_gain_db_;
    int kept_db_;
};

} // namespace frustumscreen::show
