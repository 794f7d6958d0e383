#include "app/settings/check_settings.h"
#include "app/settings/describe_settings.h"
#include "app/settings/table_reader.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen {

namespace {

constexpr std::uintmax_t largest_file_bytes = std::uintmax_t{1} << 20;
/// Each dot of a key nests a table, and toml++ destroys tables by recursion: this bounds its depth.
constexpr std::ptrdiff_t most_dots = 5000;

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
    const auto refuse = [](std::string message) {
        return fail(ErrorKind::BadConfiguration, std::move(message));
    };
    ReadState state{printable(file.string(), 4096), file.parent_path(), {}, std::nullopt};
    if (text.size() > largest_file_bytes) {
        return refuse(
            located(state.file, 0,
                    fmt::format("is {} bytes; allowed are at most {}", text.size(), largest_file_bytes)));
    }
    if (const auto dots = std::count(text.begin(), text.end(), '.'); dots > most_dots) {
        return refuse(
            located(state.file, 0, fmt::format("holds {} dots; allowed are at most {}", dots, most_dots)));
    }
    try {
        const toml::table root = toml::parse(text);
        Settings settings;
        TableReader keys(state, &root, "");
        all_settings(keys, settings);
        keys.finish();
        if (!state.error) {
            state.error = unfit(settings, state.file, state.lines);
        }
        if (state.error) {
            return refuse(*state.error);
        }
        return CheckedSettings(std::move(settings));
    } catch (const toml::parse_error& error) {
        return refuse(located(state.file, static_cast<std::uint32_t>(error.source().begin.line),
                              fmt::format("is not TOML: {}", printable(error.description(), 200))));
    } catch (const std::exception& error) {
        return refuse(
            located(state.file, 0, fmt::format("cannot be read: {}", printable(error.what(), 200))));
    }
}

Result<CheckedSettings> load_settings(const std::filesystem::path& file) {
    const Result<Bytes> bytes = read_file(file, largest_file_bytes);
    if (!bytes) {
        return fail(ErrorKind::BadConfiguration, bytes.error().message);
    }
    return parse_settings(as_text(*bytes), file);
}

} // namespace frustumscreen
