#include "app/settings/check_settings.h"
#include "app/settings/describe_settings.h"
#include "app/settings/toml_file.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/printable.h"

namespace frustumscreen {

namespace {

constexpr std::uintmax_t largest_file_bytes = std::uintmax_t{1} << 20;

} // namespace

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

std::string_view name_of(LineBias bias) {
    return bias_names[static_cast<std::size_t>(bias)];
}

std::string_view name_of(TrackerKind kind) {
    return tracker_names[static_cast<std::size_t>(kind)];
}

Result<CheckedSettings> parse_settings(std::string_view text, const std::filesystem::path& file) {
    ReadState state{printable(file.string(), 4096), file.parent_path(), {}, std::nullopt};
    Settings settings;
    read_toml(state, text, largest_file_bytes, [&](const toml::table& root) {
        TableReader keys(state, &root, "");
        all_settings(keys, settings);
        keys.finish();
        if (!state.error) {
            state.error = unfit(settings, state.file, state.lines);
        }
    });
    if (state.error) {
        return fail(ErrorKind::BadConfiguration, *std::move(state.error));
    }
    return CheckedSettings(std::move(settings));
}

Result<CheckedSettings> load_settings(const std::filesystem::path& file) {
    const Result<Bytes> bytes = read_file(file, largest_file_bytes);
    if (!bytes) {
        return fail(ErrorKind::BadConfiguration, bytes.error().message);
    }
    return parse_settings(as_text(*bytes), file);
}

} // namespace frustumscreen
