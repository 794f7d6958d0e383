/// What the watchdog wants to be shown, as it stands in its file `mode` (app/watch/step.h), and which settings and packs that takes.
///
/// Threads  any.
/// Errors   wrong settings; in mode built_in only where no others can be used either. An exhibit without a watchdog, or with one
///          that it does not understand, shows what its settings say.
#pragma once

#include "app/show/last_good_settings.h"
#include "app/watch/step.h"
#include "firmware_host/service/journal.h"

#include <filesystem>
#include <functional>
#include <vector>

namespace frustumscreen {

struct RunPlaces {
    std::filesystem::path config;
    std::filesystem::path mode_file;                            ///< empty: the mode is normal
    std::filesystem::path shipped = "/usr/share/frustumscreen"; ///< built_in.fspack, kiosk.toml
    std::filesystem::path
        cache; ///< settings_last_good.toml, volume.txt, compiled shaders; empty: none are kept
    /// Of the volume that the staff chose (kept_volume.h).
    [[nodiscard]] std::filesystem::path volume_file() const {
        return cache.empty() ? std::filesystem::path() : cache / "volume.txt";
    }
};
struct RunMode {
    Mode mode = Mode::Normal; ///< never Safe
    UsedSettings used;
    std::vector<std::filesystem::path> packs; ///< in place of all others; none: no others are wanted
};

/// Normal where there is no file; what is none of the exhibit's modes is said in one line.
[[nodiscard]] Mode read_run_mode(const std::filesystem::path& file);
[[nodiscard]] Result<RunMode> choose_run_mode(const RunPlaces& places, const Journal& journal);
/// Tells the graphics driver how to draw and where to keep compiled shaders. Call before the first display. Plain drawing and the
/// built-in artifact keep none; where shaders cannot be kept, one line says so.
void prepare_driver(const RunPlaces& places, Mode mode, const Journal& journal);
/// Keeps the staff's volume, and a copy of settings that showed an artifact well; neither where the built-in one is shown, of which
/// they say little.
[[nodiscard]] std::function<void(const RunStatus&)> keeper_of(const RunPlaces& places, const RunMode& mode);

} // namespace frustumscreen
