#include "app/settings/missing_files.h"

#include "firmware_host/base/local_time.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <string_view>

namespace frustumscreen::settings {

std::vector<std::string> missing_files(const Settings& settings) {
    std::vector<std::string> lines;
    const auto look = [&](const std::string& key, const std::filesystem::path& file,
                          std::string_view remedy) {
        std::error_code failed;
        if (std::filesystem::is_directory(file, failed)) {
            lines.push_back(fmt::format("{}: {}: this is a folder; name a file in it", key,
                                        printable(file.string(), 4096)));
        } else if (!std::filesystem::exists(file, failed)) {
            lines.push_back(fmt::format("{}: {}: there is no such file; {}", key,
                                        printable(file.string(), 4096), remedy));
        }
    };
    for (const std::filesystem::path& pack : settings.exhibit.packs) {
        look(settings.exhibit.packs_key, pack, "make it with frustumscreen-bake, or take it off the list");
    }
    if (!settings.exhibit.words.empty()) {
        look("exhibit.words", settings.exhibit.words,
             "make it with frustumscreen-bake --words, or leave the line out");
    }
    if (settings.screen.exists()) {
        look("screen.room", settings.screen.room,
             "write it (docs/room.md), or leave the line out: then there is no screen");
    }
    if (settings.tracker.kind == TrackerKind::Replay) {
        look(settings.tracker.poses_key, settings.tracker.poses,
             "make it with frustumscreen record, or choose another tracker.kind");
    }
    for (const std::string& note : settings.prop.notes) {
        lines.push_back(fmt::format("{}: {}",
                                    settings.prop.file.empty()
                                        ? "prop.shape"
                                        : "prop.file: " + printable(settings.prop.file.string(), 4096),
                                    note));
    }
    const std::string& zone = settings.hours.time_zone;
    if (!zone.empty() && !has_time_zone(zone)) {
        lines.push_back(fmt::format("hours.time_zone: this machine has no time zone \"{}\", so its own is "
                                    "used; timedatectl list-timezones lists those that it has",
                                    zone));
    }
    lines.insert(lines.end(), settings.calibration.unused.begin(), settings.calibration.unused.end());
    return lines;
}

} // namespace frustumscreen::settings
