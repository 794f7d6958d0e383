/// The mode that the watchdog asks for in its file `mode` (app/watch/step.h), and the settings and packs for it.
///
/// Threads  any.
/// Errors   wrong settings; in mode built_in only if no fallback settings can be used either. Without a watchdog, or
///          with an unknown mode, the exhibit shows what its settings say.
#pragma once

#include "app/show/last_good_settings.h"
#include "app/watch/step.h"
#include "firmware_host/service/journal.h"

#include <filesystem>
#include <functional>
#include <vector>

namespace frustumscreen::programs {

struct RunPlaces {
    std::filesystem::path config;
    std::filesystem::path mode_file;                            ///< empty: the mode is normal
    std::filesystem::path shipped = "/usr/share/frustumscreen"; ///< built_in.fspack, kiosk.toml
    std::filesystem::path
        cache; ///< settings_last_good.toml, volume.txt, stereo.txt, compiled shaders; empty: none are kept
    /// File with the volume that the staff chose (kept_volume.h).
    [[nodiscard]] std::filesystem::path volume_file() const {
        return cache.empty() ? std::filesystem::path() : cache / "volume.txt";
    }
};
struct RunMode {
    watch::Mode mode = watch::Mode::Normal; ///< never Safe
    show::UsedSettings used;
    std::vector<std::filesystem::path> packs; ///< replace all others; none: keep the others
};

/// Normal if there is no file. Reports an unknown mode in one line.
[[nodiscard]] watch::Mode read_run_mode(const std::filesystem::path& file);
[[nodiscard]] Result<RunMode> choose_run_mode(const RunPlaces& places, const service::Journal& journal);
/// Tells the graphics driver how to draw and where to keep compiled shaders. Call before the first display. Modes plain
/// and built_in keep none; a folder that cannot keep shaders is reported in one line.
void prepare_driver(const RunPlaces& places, watch::Mode mode, const service::Journal& journal);
/// Keeps the projector's stereo layout for the safe picture, whose program reads no settings. Not in mode built_in, whose
/// settings may be those as shipped.
void keep_stereo(const RunPlaces& places, const RunMode& mode);
/// Keeps the staff's volume, and a copy of settings that showed an artifact well. Keeps neither in mode built_in, which
/// says little about the settings.
[[nodiscard]] std::function<void(const show::RunStatus&)> keeper_of(const RunPlaces& places,
                                                                    const RunMode& mode);

} // namespace frustumscreen::programs
