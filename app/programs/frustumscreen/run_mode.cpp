#include "app/programs/frustumscreen/run_mode.h"

#include "app/show/kept_volume.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/standard_error.h"
#include "firmware_host/display/plain_drawing.h"
#include "firmware_host/display/shader_cache.h"

#include <fmt/format.h>

#include <utility>

namespace frustumscreen {

namespace {

constexpr std::uintmax_t max_bytes = 64;

void tell_of_calibration(const CalibrationSettings& calibration, const Journal& journal) {
    for (const std::string& why : calibration.unused) {
        journal.note(LogPriority::Error, why);
    }
    if (calibration.used) {
        journal.note(LogPriority::Info,
                     fmt::format("calibration: {} is used, made {}, of {} places", calibration.used_name,
                                 calibration.used->made, calibration.used->places));
    }
}

std::filesystem::path last_good(const RunPlaces& places) {
    return places.cache.empty() ? std::filesystem::path() : places.cache / "settings_last_good.toml";
}

} // namespace

Mode read_run_mode(const std::filesystem::path& file) {
    std::error_code failed;
    if (file.empty() || !std::filesystem::exists(file, failed)) {
        return Mode::Normal;
    }
    const Result<Bytes> bytes = read_file(file, max_bytes);
    if (!bytes) {
        say_line("frustumscreen", fmt::format("{}; the mode is normal", bytes.error().message));
        return Mode::Normal;
    }
    std::string_view word = as_text(*bytes);
    word = word.substr(0, word.find_first_of(" \r\n"));
    const std::optional<Mode> mode = mode_named(word);
    if (!mode) {
        say_line("frustumscreen", fmt::format("{}: unknown mode '{}'; allowed are normal, last_good_set, "
                                              "plain and built_in; the mode is normal",
                                              file.string(), word));
    }
    // A person who starts the exhibit while the safe picture is shown wants the exhibit.
    return mode && *mode != Mode::Safe ? *mode : Mode::Normal;
}

Result<RunMode> choose_run_mode(const RunPlaces& places, const Journal& journal) {
    const Mode mode = read_run_mode(places.mode_file);
    std::optional<SettingsFallback> fallback;
    std::vector<std::filesystem::path> packs;
    if (mode == Mode::BuiltIn) {
        packs = {places.shipped / "built_in.fspack"};
        fallback = SettingsFallback{last_good(places), places.shipped / "kiosk.toml"};
    }
    TRY(UsedSettings used, use_settings(places.config, fallback));
    if (mode != Mode::Normal) {
        journal.note(LogPriority::Warning, fmt::format("the watchdog asks for the mode {}", word_of(mode)));
    }
    if (!used.instead.empty()) {
        journal.note(LogPriority::Error, used.instead);
    }
    tell_of_calibration(used.settings->calibration, journal);
    return RunMode{mode, std::move(used), std::move(packs)};
}

void prepare_driver(const RunPlaces& places, Mode mode, const Journal& journal) {
    if (mode == Mode::Plain) {
        draw_plainly();
    } else if (mode == Mode::BuiltIn) {
        keep_no_shaders();
    } else if (!places.cache.empty()) {
        if (const Result<void> kept = keep_shaders_in(places.cache); !kept) {
            journal.note(LogPriority::Warning, kept.error().message);
        }
    }
}

std::function<void(const RunStatus&)> keeper_of(const RunPlaces& places, const RunMode& mode) {
    if (places.cache.empty() || mode.mode == Mode::BuiltIn) {
        return {};
    }
    return [keeper = SettingsKeeper(last_good(places), mode.used.text),
            volume = VolumeKeeper(places.volume_file(), mode.used.settings->sound.gain_db)](
               const RunStatus& status) mutable {
        keeper.note(status);
        volume.note(status.louder_db);
    };
}

} // namespace frustumscreen
