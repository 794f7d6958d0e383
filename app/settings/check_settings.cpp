#include "app/settings/check_settings.h"

#include "app/settings/check_outputs.h"
#include "app/settings/fitness.h"
#include "app/settings/lit_zone.h"
#include "app/settings/table_reader.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

namespace frustumscreen::settings {

namespace {

/// A script that repeats faster would press more often than a person can; one that repeats every microsecond would
/// press without end.
constexpr double min_repeat_s = 0.05;

/// "03" is offset 3.
std::string_view line_id(std::string_view line) {
    const bool offset = line.find_first_not_of("0123456789") == std::string_view::npos;
    return offset ? line.substr(std::min(line.find_first_not_of('0'), line.size() - 1)) : line;
}

/// The first of `lines` that occurs in `taken` or earlier in `lines`; empty if there is none.
std::string_view used_twice(const std::vector<std::string>& lines,
                            const std::vector<std::string>& taken = {}) {
    std::vector<std::string_view> used;
    std::transform(taken.begin(), taken.end(), std::back_inserter(used), line_id);
    for (const std::string& line : lines) {
        if (std::find(used.begin(), used.end(), line_id(line)) != used.end()) {
            return line;
        }
        used.push_back(line_id(line));
    }
    return {};
}

/// The kernel would report a line used twice as busy, as if another program held it; a key used twice would be two
/// buttons.
void check_each_is_used_once(const PanelSettings& panel, Fitness& fitness) {
    const auto require_once = [&](std::string_view again, std::string_view key, std::string_view remedy) {
        fitness.require("settings.named_twice", again.empty(), key,
                        fmt::format("names \"{}\" again; {}", printable(again, 40), remedy));
    };
    require_once(used_twice(panel.lines), "panel.lines", "give each button a line of its own");
    require_once(used_twice(panel.lamps, panel.lines), "panel.lamps",
                 "give each lamp a line of its own that is not in panel.lines");
    require_once(used_twice(panel.keys), "panel.keys", "give each button a key of its own");
}

void check_devices(const Settings& settings, Fitness& fitness) {
    fitness.require("settings.force_without_mode", !settings.display.force || settings.display.mode.width > 0,
                    "display.force",
                    "is true; it needs display.mode, the mode to force, such as \"1280x800@60\"");
    fitness.require("settings.replay_without_poses",
                    settings.tracker.kind != TrackerKind::Replay || !settings.tracker.poses.empty(),
                    "tracker.kind",
                    "is \"replay\"; it needs tracker.poses, the pose file or recording to replay");
    fitness.require(
        "settings.gpio_without_lines",
        settings.panel.kind != PanelKind::Gpio || !settings.panel.lines.empty(), "panel.kind",
        "is \"gpio\"; it needs panel.lines, the names or offsets of the buttons' lines: previous, "
        "next, language");
    fitness.require("settings.keys_without_device",
                    settings.panel.kind != PanelKind::Keys ||
                        (!settings.panel.device.empty() && !settings.panel.keys.empty()),
                    "panel.kind",
                    "is \"keys\"; it needs panel.device, a path or name of a keyboard in /dev/input, and "
                    "panel.keys, such as [\"KEY_LEFT\", \"KEY_RIGHT\", \"KEY_L\"]: previous, next, language");
    fitness.require("settings.lamps", settings.panel.lamps.size() <= settings.panel.lines.size(),
                    "panel.lamps",
                    fmt::format("names {} lamps; allowed is one for each of the {} lines of panel.lines",
                                settings.panel.lamps.size(), settings.panel.lines.size()));
    check_each_is_used_once(settings.panel, fitness);
    const auto& script = settings.panel.script;
    fitness.require(
        "settings.script_order",
        std::is_sorted(script.begin(), script.end(),
                       [](const ScriptedPress& a, const ScriptedPress& b) { return a.at_s < b.at_s; }),
        "panel.script", "goes back in time; sort it by at_s");
    const double last_s = script.empty() ? 0.0 : script.back().at_s;
    fitness.require(
        "settings.script_repeat",
        script.empty() || settings.panel.repeat_s == 0.0 ||
            (settings.panel.repeat_s > last_s && settings.panel.repeat_s >= min_repeat_s),
        "panel.repeat_s",
        fmt::format("is {}; allowed are 0 (once) and times after the last press, {} seconds, of at "
                    "least {} seconds",
                    settings.panel.repeat_s, last_s, min_repeat_s));
}

/// A function that locates things in the camera's picture needs the camera's lens.
void check_camera_lens(const CameraSettings& camera, std::string_view use, std::string_view sees,
                       Fitness& fitness) {
    fitness.require("settings.camera_needed", camera.kind == CameraKind::V4l2, use,
                    fmt::format("is true; it needs camera.kind = \"v4l2\", the camera that sees {}", sees));
    fitness.require("settings.camera_focal_length", camera.pinhole.fx > 0.0 && camera.pinhole.fy > 0.0, use,
                    "is true; it needs camera.fx, the measured focal length in pixels");
    if (camera.pinhole.fx > 0.0 && camera.pinhole.fy > 0.0) {
        check_lens(camera.pinhole, "camera.k1", fitness);
    }
}

/// Tags need the camera's lens and pose, and the tags' places.
void check_tags(const CameraSettings& camera, Fitness& fitness) {
    if (!camera.tags) {
        return;
    }
    check_camera_lens(camera, "camera.tags", "the tags", fitness);
    const geometry::RigidTransform& pose = camera.table_from_camera;
    fitness.require("settings.camera_pose", pose.translation.z > 0.0 && pose.direction({0, 0, 1}).z < 0.0,
                    "camera.tags",
                    "is true; it needs camera.table_from_camera, 16 numbers that place the camera above the "
                    "table and let it look down");
    fitness.require("settings.no_tags", !camera.tag.empty(), "camera.tags",
                    "is true; it needs [[camera.tag]], one table for each tag on the prop");
    std::set<int> ids;
    for (const TagSettings& tag : camera.tag) {
        fitness.require("settings.tag_twice", ids.insert(tag.id).second, "camera.tag",
                        fmt::format("has the id {} twice; give each tag an id of its own", tag.id));
    }
}

/// Heads are detected upright, so the camera must be upright.
void check_visitor(const Settings& settings, Fitness& fitness) {
    const CameraSettings& camera = settings.camera;
    if (!camera.visitor) {
        return;
    }
    check_camera_lens(camera, "camera.visitor", "the visitors", fitness);
    const geometry::RigidTransform& pose = camera.table_from_camera;
    constexpr double upright = -0.64; // of the picture's down, along the table's up: 50 degrees
    fitness.require(
        "settings.camera_not_upright", pose.translation.z > 0.0 && pose.direction({0, 1, 0}).z < upright,
        "camera.visitor",
        "is true; it needs camera.table_from_camera, 16 numbers that place the camera above the table, "
        "upright, and let it look no more than 50 degrees up or down");
    fitness.require("settings.eye_not_tracked", settings.eye.tracked, "camera.visitor",
                    "is true; eye.tracked is false, a fixed viewer; choose one of the two");
}

void check_camera(const Settings& settings, Fitness& fitness) {
    const CameraSettings& camera = settings.camera;
    const double frame_ms = 1000.0 / camera.rate_hz;
    fitness.require(
        "settings.exposure", camera.exposure_ms <= frame_ms, "camera.exposure_ms",
        fmt::format("is {}; a frame at camera.rate_hz, {} hertz, takes {:.1f} milliseconds, allowed are 0 "
                    "and times up to that",
                    camera.exposure_ms, camera.rate_hz, frame_ms));
    fitness.require(
        "settings.rolling_shutter", camera.rolling_shutter_ms <= frame_ms, "camera.rolling_shutter_ms",
        fmt::format("is {}; a frame at camera.rate_hz, {} hertz, takes {:.1f} milliseconds, allowed are 0 "
                    "and times up to that",
                    camera.rolling_shutter_ms, camera.rate_hz, frame_ms));
    constexpr int min_kelvin = 2000; // a candle's light
    fitness.require("settings.white_balance",
                    camera.white_balance_k == 0 || camera.white_balance_k >= min_kelvin,
                    "camera.white_balance_k",
                    fmt::format("is {}; allowed are 0 (the camera's own) and {} to 10000 kelvin",
                                camera.white_balance_k, min_kelvin));
    fitness.require("settings.drift_without_camera", !camera.drift || camera.kind == CameraKind::V4l2,
                    "camera.drift",
                    "is true; it needs camera.kind = \"v4l2\", a camera that sees the whole picture");
    check_tags(camera, fitness);
    check_visitor(settings, fitness);
}

/// The device that reports the torch must be there.
void check_torch_source(const Settings& settings, Fitness& fitness) {
    const TorchSettings& torch = settings.torch;
    const TrackerKind tracker = settings.tracker.kind;
    const std::string source(name_of(torch.source));
    fitness.require(
        "settings.torch_without_tracker",
        !torch.by_tracker() || (tracker != TrackerKind::None && tracker != TrackerKind::SpaceMouse),
        "torch.source",
        fmt::format("is \"{}\", and tracker.kind is \"{}\", which has no station 3; allowed are \"usb\", "
                    "\"simulated\" and \"replay\", or another torch.source",
                    source, name_of(tracker)));
    fitness.require("settings.torch_without_tags", !torch.by_camera() || settings.camera.tags, "torch.source",
                    fmt::format("is \"{}\"; it needs camera.tags = true, the camera that sees the tag on the "
                                "lamp",
                                source));
    const auto& tags = settings.camera.tag;
    fitness.require("settings.torch_tag_twice",
                    !torch.by_camera() ||
                        std::none_of(tags.begin(), tags.end(),
                                     [&](const TagSettings& tag) { return tag.id == torch.tag.id; }),
                    "torch.tag.id",
                    fmt::format("is {}, as that of a tag on the prop; give the lamp's tag an id of its own",
                                torch.tag.id));
}

void check_torch(const Settings& settings, Fitness& fitness) {
    const TorchSettings& torch = settings.torch;
    const double opening_deg = std::round(1e9 * glm::degrees(torch.beam.opening_rad)) / 1e9;
    fitness.require(
        "settings.torch_opening",
        !torch.exists() || (torch.min_opening_deg <= opening_deg && opening_deg <= torch.max_opening_deg),
        "torch.opening_deg",
        fmt::format("is {}; allowed are degrees from torch.min_opening_deg, {}, to torch.max_opening_deg, {}",
                    opening_deg, torch.min_opening_deg, torch.max_opening_deg));
    const bool ends = torch.beam.attenuation == torch::Attenuation::Linear ||
                      torch.beam.attenuation == torch::Attenuation::SmoothStep;
    fitness.require("settings.torch_dark", !ends || torch.beam.full_m < torch.beam.dark_m, "torch.dark_m",
                    fmt::format("is {}; the light falls from torch.full_m to there, allowed are more than {} "
                                "metres",
                                torch.beam.dark_m, torch.beam.full_m));
    check_torch_source(settings, fitness);
}

/// A window must fit into the lit table, with the prop beside it.
void check_windows(const Settings& settings, Fitness& fitness) {
    const WindowSettings& windows = settings.windows;
    if (!windows.exist()) {
        return;
    }
    const Rectangle lit = rectangle_inside(picture_on_table(settings, 0.0));
    const double width_m = 2.0 * lit.half_m.x, depth_m = 2.0 * lit.half_m.y;
    const bool fits_along = windows.width_m + settings.prop.base_m <= width_m && windows.depth_m <= depth_m;
    const bool fits_behind = windows.depth_m + settings.prop.base_m <= depth_m && windows.width_m <= width_m;
    const bool is_wide = windows.width_m >= windows.depth_m;
    fitness.require(
        "settings.window_size", fits_along || fits_behind, is_wide ? "windows.width_m" : "windows.depth_m",
        fmt::format("is {}; a window must lie beside the prop, {} metres wide, in the lit part of the "
                    "table, {:.2f} x {:.2f} metres; make windows smaller",
                    is_wide ? windows.width_m : windows.depth_m, settings.prop.base_m, width_m, depth_m));
}

/// Two keys of the same name would make messages ambiguous.
void check_keys(const Settings& settings, Fitness& fitness) {
    std::set<std::string_view> names;
    for (const pack::TrustedKey& key : settings.exhibit.keys) {
        fitness.require(
            "settings.key_twice", names.insert(key.name).second, "exhibit.keys",
            fmt::format("has two keys called \"{}\"; give each a name of its own", printable(key.name, 40)));
    }
}

void check_sound(const Settings& settings, Fitness& fitness) {
    const auto& hours = settings.sound.hours;
    fitness.require("settings.sound_hours",
                    std::adjacent_find(hours.begin(), hours.end(),
                                       [](const SoundHour& a, const SoundHour& b) {
                                           return a.from_h >= b.from_h;
                                       }) == hours.end(),
                    "sound.hours", "goes back in time or names an hour twice; sort it by from_h");
}

/// A day cannot be both closed and open.
void check_hours(const Settings& settings, Fitness& fitness) {
    const std::vector<HoursException>& exceptions = settings.hours.exceptions;
    for (const HoursException& each : exceptions) {
        const auto open = [&each](const HoursException& other) {
            return other.day == each.day && other.open;
        };
        fitness.require("settings.exception_twice",
                        each.open || std::none_of(exceptions.begin(), exceptions.end(), open),
                        "hours.exceptions",
                        fmt::format("has \"{}\" and times of that day; take one of the two out",
                                    text_of_exception(each)));
    }
}

} // namespace

std::optional<Error> unfit(const Settings& settings, const std::string& file, const KeyLines& lines) {
    Fitness fitness(file, lines);
    check_outputs(settings, fitness);
    check_devices(settings, fitness);
    check_camera(settings, fitness);
    check_torch(settings, fitness);
    check_windows(settings, fitness);
    check_sound(settings, fitness);
    check_keys(settings, fitness);
    check_hours(settings, fitness);
    return fitness.error();
}

} // namespace frustumscreen::settings
