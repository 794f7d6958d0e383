#include "app/programs/frustumscreen/run_mode.h"

#include "app/show/kept_volume.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/standard_error.h"
#include "firmware_host/display/plain_drawing.h"
#include "firmware_host/display/shader_cache.h"

#include <fmt/format.h>

#include <utility>

namespace frustumscreen::programs {

namespace {

constexpr std::uintmax_t max_bytes = 64;

void tell_of_calibration(const settings::CalibrationSettings& calibration, const service::Journal& journal) {
    for (const std::string& why : calibration.unused) {
        journal.note(service::LogPriority::Error, why);
    }
    if (calibration.used) {
        journal.note(service::LogPriority::Info,
                     fmt::format("calibration: {} is used, made {}, of {} places", calibration.used_name,
                                 calibration.used->made, calibration.used->places));
    }
}

void tell_of_prop(const settings::PropSettings& prop, const service::Journal& journal) {
    for (const std::string& note : prop.notes) {
        journal.note(service::LogPriority::Info, fmt::format("the prop's shape: {}", note));
    }
}

std::filesystem::path last_good(const RunPlaces& places) {
    return places.cache.empty() ? std::filesystem::path() : places.cache / "settings_last_good.toml";
}

} // namespace

watch::Mode read_run_mode(const std::filesystem::path& file) {
    std::error_code failed;
    if (file.empty() || !std::filesystem::exists(file, failed)) {
        return watch::Mode::Normal;
    }
    const Result<Bytes> bytes = read_file(file, max_bytes);
    if (!bytes) {
        say_line("frustumscreen", fmt::format("{}; the mode is normal", bytes.error().message));
        return watch::Mode::Normal;
    }
    std::string_view word = as_text(*bytes);
    word = word.substr(0, word.find_first_of(" \r\n"));
    const std::optional<watch::Mode> mode = watch::mode_named(word);
    if (!mode) {
        say_line("frustumscreen", fmt::format("{}: unknown mode '{}'; allowed are normal, last_good_set, "
                                              "plain and built_in; the mode is normal",
                                              file.string(), word));
    }
    // A person who starts the exhibit while the safe picture is shown wants the exhibit.
    return mode && *mode != watch::Mode::Safe ? *mode : watch::Mode::Normal;
}

Result<RunMode> choose_run_mode(const RunPlaces& places, const service::Journal& journal) {
    const watch::Mode mode = read_run_mode(places.mode_file);
    std::optional<show::SettingsFallback> fallback;
    std::vector<std::filesystem::path> packs;
    if (mode == watch::Mode::BuiltIn) {
        packs = {places.shipped / "built_in.fspack"};
        fallback = show::SettingsFallback{last_good(places), places.shipped / "kiosk.toml"};
    }
    TRY(show::UsedSettings used, show::use_settings(places.config, fallback));
    if (mode != watch::Mode::Normal) {
        journal.note(service::LogPriority::Warning,
                     fmt::format("the watchdog asks for the mode {}", watch::word_of(mode)));
    }
    if (!used.instead.empty()) {
        journal.note(service::LogPriority::Error, used.instead);
    }
    tell_of_calibration(used.settings->calibration, journal);
    tell_of_prop(used.settings->prop, journal);
    return RunMode{mode, std::move(used), std::move(packs)};
}

void prepare_driver(const RunPlaces& places, watch::Mode mode, const service::Journal& journal) {
    if (mode == watch::Mode::Plain) {
        display::draw_plainly();
    } else if (mode == watch::Mode::BuiltIn) {
        display::keep_no_shaders();
    } else if (!places.cache.empty()) {
        if (const Result<void> kept = display::keep_shaders_in(places.cache); !kept) {
            journal.note(service::LogPriority::Warning, kept.error().message);
        }
    }
}

void keep_stereo(const RunPlaces& places, const RunMode& mode) {
    if (places.cache.empty() || mode.mode == watch::Mode::BuiltIn) {
        return;
    }
    const std::filesystem::path file = places.cache / "stereo.txt";
    const std::string layout =
        fmt::format("{}\n", settings::name_of(settings::stereo_of(*mode.used.settings)));
    if (const Result<Bytes> kept = read_file(file, max_bytes); kept && as_text(*kept) == layout) {
        return;
    }
    if (const Result<void> written = write_file(file, as_bytes(layout)); !written) {
        say_line("frustumscreen", "the safe picture is not told of stereo: " + written.error().message);
    }
}

std::function<void(const show::RunStatus&)> keeper_of(const RunPlaces& places, const RunMode& mode) {
    if (places.cache.empty() || mode.mode == watch::Mode::BuiltIn) {
        return {};
    }
    return [keeper = show::SettingsKeeper(last_good(places), mode.used.text),
            volume = show::VolumeKeeper(places.volume_file(), mode.used.settings->sound.gain_db)](
               const show::RunStatus& status) mutable {
        keeper.note(status);
        volume.note(status.louder_db);
    };
}

} // namespace frustumscreen::programs
