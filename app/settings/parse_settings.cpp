#include "app/settings/check_settings.h"
#include "app/settings/describe_settings.h"
#include "app/settings/kept_calibrations.h"
#include "app/settings/read_prop.h"
#include "app/settings/toml_file.h"
#include "firmware_host/base/disk_tree.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

namespace frustumscreen::settings {

namespace {

constexpr std::uintmax_t largest_file_bytes = std::uintmax_t{1} << 20;

ReadState state_of(const std::filesystem::path& file) {
    return {.file = printable(file.string(), 4096),
            .folder = file.parent_path(),
            .lines = {},
            .error = std::nullopt};
}

void read(ReadState& state, std::string_view text, Settings& settings) {
    read_toml(state, text, largest_file_bytes, [&](const toml::table& root) {
        TableReader keys(state, &root, "");
        all_settings(keys, settings);
        keys.finish();
    });
    read_prop(state, settings.prop);
}

/// Why these settings cannot be used; nothing if they can.
std::optional<Error> refusal(const ReadState& state, const Settings& settings) {
    std::optional<Error> why = state.error ? state.error : unfit(settings, state.file, state.lines);
    if (why) {
        why->kind = ErrorKind::BadConfiguration;
    }
    return why;
}

/// The settings with this calibration, or why it cannot be used.
Result<Settings> calibrated(Settings settings, const Result<Calibration>& calibration,
                            const ReadState& state) {
    TRY_VOID(calibration);
    settings.projector.pinhole = calibration->pinhole;
    settings.projector.table_from_projector = calibration->table_from_projector;
    const glm::dvec3 right_in_sensor = settings.tracker.registration.right_in_sensor;
    settings.tracker.registration = calibration->registration;
    settings.tracker.registration.right_in_sensor = right_in_sensor; // a calibration keeps none
    if (std::optional<Error> why = unfit(settings, state.file, state.lines)) {
        return as_kind(ErrorKind::BadInput, *std::move(why));
    }
    settings.calibration.used = *calibration;
    return settings;
}

/// A damaged calibration must not leave the table dark: the previous one is used, or else the values of the
/// settings.
void use_newest_calibration(Settings& settings, const ReadState& state) {
    const std::filesystem::path& folder = settings.calibration.folder;
    std::error_code none;
    if (!std::filesystem::exists(folder, none)) {
        return;
    }
    std::vector<std::string> unused;
    const auto note = [&](std::string_view name, const Error& error) {
        unused.push_back(fmt::format("{}: this calibration is not used: {}",
                                     printable((folder / name).string(), 4096), error.message));
    };
    const Result<std::unique_ptr<WritableTree>> tree = open_tree(folder);
    const Result<std::vector<KeptCalibration>> kept =
        tree ? list_calibrations(**tree) : tl::unexpected<Error>(tree.error());
    if (!kept) {
        note("", kept.error());
    }
    for (const KeptCalibration& each : kept ? *kept : std::vector<KeptCalibration>{}) {
        Result<Settings> with = calibrated(settings, read_calibration(**tree, each), state);
        if (with) {
            settings = *std::move(with);
            settings.calibration.used_name = each.name;
            break;
        }
        note(each.name, with.error());
    }
    settings.calibration.unused = std::move(unused);
}

Stereo stereo_of(OutputStereo output, Stereo of_eye) {
    switch (output) {
    case OutputStereo::AsEye:
        return of_eye;
    case OutputStereo::Off:
        return Stereo::Off;
    case OutputStereo::SideBySide:
        return Stereo::SideBySide;
    case OutputStereo::TopBottom:
        return Stereo::TopBottom;
    case OutputStereo::FrameSequential:
        return Stereo::FrameSequential;
    case OutputStereo::Anaglyph:
        return Stereo::Anaglyph;
    }
    return Stereo::Off;
}

} // namespace

std::string_view name_of(Stereo stereo) {
    return stereo_names[static_cast<std::size_t>(stereo)];
}

Stereo stereo_of(const Settings& settings) {
    return stereo_of(settings.projector.stereo, settings.eye.stereo);
}

Stereo screen_stereo_of(const Settings& settings) {
    return stereo_of(settings.screen.stereo, settings.eye.stereo);
}

std::string_view name_of(DisplayKind kind) {
    return display_names[static_cast<std::size_t>(kind)];
}

std::string_view name_of(PropKind kind) {
    return prop_names.at(static_cast<std::size_t>(kind));
}

std::string_view name_of(PanelKind kind) {
    return panel_names[static_cast<std::size_t>(kind)];
}

std::string_view name_of(SoundKind kind) {
    return sound_names[static_cast<std::size_t>(kind)];
}

std::string_view name_of(CameraKind kind) {
    return camera_names[static_cast<std::size_t>(kind)];
}

std::string_view name_of(TorchSource source) {
    return torch_source_names[static_cast<std::size_t>(source)];
}

std::string_view name_of(LineBias bias) {
    return bias_names[static_cast<std::size_t>(bias)];
}

std::string_view name_of(TrackerKind kind) {
    return tracker_names[static_cast<std::size_t>(kind)];
}

Result<CheckedSettings> parse_settings(std::string_view text, const std::filesystem::path& file) {
    ReadState state = state_of(file);
    Settings settings;
    read(state, text, settings);
    if (const std::optional<Error> refused = refusal(state, settings)) {
        return tl::unexpected<Error>(*refused);
    }
    return CheckedSettings(std::move(settings));
}

Result<CheckedSettings> load_settings(const std::filesystem::path& file) {
    const Result<Bytes> bytes = read_file(file, largest_file_bytes);
    if (!bytes) {
        return as_kind(ErrorKind::BadConfiguration, bytes.error());
    }
    return kiosk_settings(as_text(*bytes), file);
}

Result<CheckedSettings> kiosk_settings(std::string_view text, const std::filesystem::path& file) {
    ReadState state = state_of(file);
    Settings settings;
    read(state, text, settings);
    if (!state.error) {
        use_newest_calibration(settings, state);
    }
    if (const std::optional<Error> refused = refusal(state, settings)) {
        return tl::unexpected<Error>(*refused);
    }
    return CheckedSettings(std::move(settings));
}

} // namespace frustumscreen::settings
