/// How much louder than the settings say the staff made the exhibit with its buttons: kept over restarts, in a file of one line.
///
///     louder_db 3 over 0
///
/// Rule     it counts as long as the settings' own volume (`sound.gain_db`) is the one over which it was chosen. Settings with another
///          volume win, and the next choice begins from theirs.
/// Units    decibels.
/// Threads  the keeper has one caller, which writes files.
/// Errors   a file that cannot be read or written is as none.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace frustumscreen {

/// 0: nothing was chosen over `settings_gain_db`.
[[nodiscard]] int read_kept_volume(const std::filesystem::path& file, double settings_gain_db);

class VolumeKeeper {
public:
    VolumeKeeper(std::filesystem::path file, double settings_gain_db);
    /// Writes where it is another one than was kept.
    void note(int louder_db);

private:
    std::filesystem::path file_;
    double settings_gain_db_;
    int kept_db_;
};

} // namespace frustumscreen
