/// Every setting, described once: its name, its range, its purpose. Its default is that of its struct. The
/// reader of the file (TableReader), the report (config_json.cpp) and the page (settings_page.cpp) walk this
/// description, in this order.
///
/// A walker's `reads` is true if it fills in the values. An `input` is read and other settings are computed from
/// it; it is not kept.
///
/// Threads  pure; any.
#pragma once

#include "app/settings/command.h"
#include "app/settings/describe_outputs.h"
#include "app/settings/describe_torch.h"
#include "app/settings/describe_windows.h"
#include "app/settings/language_tag.h"
#include "app/settings/range.h"
#include "app/settings/settings.h"
#include "firmware_host/base/calendar_day.h"

#include <array>
#include <functional>
#include <string_view>

namespace frustumscreen::settings {

inline constexpr std::size_t max_packs = 256;
inline constexpr std::string_view allowed_public_keys =
    "public keys of minisign: the line of 56 letters in NAME.pub, which begins with RW";
inline constexpr std::string_view allowed_last_days = "days such as \"2030-12-31\"";
inline constexpr std::size_t max_presses = 1000;
inline constexpr double longest_script_s = 86400.0;
inline constexpr std::size_t max_tags = 64;
inline constexpr std::size_t max_hours = 24;
inline constexpr std::size_t max_spans = 8;
inline constexpr std::size_t max_exceptions = 1000;
inline constexpr std::string_view allowed_spans =
    "times such as \"10:00-18:00\"; \"20:00-02:00\" goes on after midnight, \"00:00-24:00\" is a whole day";
inline constexpr std::string_view allowed_exceptions =
    "days such as \"2026-12-24 10:00-14:00\" and \"2026-12-25 closed\"";
inline constexpr std::string_view allowed_time_zones =
    "names such as \"Europe/Berlin\"; timedatectl list-timezones lists them";
inline constexpr std::array<const char*, 7> weekday_names{"monday", "tuesday",  "wednesday", "thursday",
                                                          "friday", "saturday", "sunday"};
inline constexpr Range sound_gain{-60.0, 12.0, "decibels"};

/// Each list is in the order of its enumeration.
inline constexpr std::array<std::string_view, 5> tracker_names{"simulated", "replay", "usb", "spacemouse",
                                                               "none"};
inline constexpr std::array<std::string_view, 3> panel_names{"scripted", "gpio", "keys"};
inline constexpr std::array<std::string_view, 2> camera_names{"none", "v4l2"};
inline constexpr std::array<std::string_view, 2> sound_names{"none", "alsa"};
inline constexpr std::array<std::string_view, 2> unsigned_names{"refuse", "allow"};
inline constexpr std::array<std::string_view, 4> bias_names{"as-is", "pull-up", "pull-down", "disabled"};

void registration_settings(auto& fields, auto& registration) {
    constexpr Range in_the_hand{-1.0, 1.0, "metres"};
    fields.rigid("table_from_tracker", registration.table_from_tracker, near_the_table,
                 "registration of a device that reports in its own frame: 16 numbers, column by column");
    fields.rigid("sensor_from_prop", registration.sensor_from_prop, near_the_table,
                 "for such a device: where the prop is, in the axes of the sensor in it; 16 numbers, column "
                 "by column");
    fields.vector("eye_in_sensor_m", registration.eye_in_sensor_m, in_the_hand,
                  "for such a device: the point between the eyes, in the axes of the sensor on the head");
}

template <typename Fields> void tracker_settings(Fields& fields, auto& tracker) {
    constexpr double shortest_direction = 1e-3;
    fields.choice("kind", tracker.kind, tracker_names,
                  "usb: a Polhemus VIPER, PATRIOT or LIBERTY, or a HID tracker, whichever is connected; "
                  "spacemouse: a 3Dconnexion SpaceMouse; none: the prop stands at the table's centre");
    fields.integer("seed", tracker.seed, "simulated: each seed gives another visitor");
    fields.path("poses", tracker.poses, "replay: a pose file or a recording of packets");
    if constexpr (Fields::reads) {
        tracker.poses_key = tracker.poses.empty() ? "" : fields.place("poses");
    }
    fields.number("replay_speed", tracker.replay_speed, {0.01, 100.0, "times as fast as recorded"}, "replay");
    fields.vector("hemisphere", tracker.hemisphere, {-1.0, 1.0, ""},
                  "usb: direction from the tracker's source to the half space in which the prop moves, in "
                  "the source's axes");
    fields.require("settings.hemisphere", glm::length(tracker.hemisphere) >= shortest_direction, "hemisphere",
                   "gives no direction; allowed are three numbers of which one is not 0");
    registration_settings(fields, tracker.registration);
    fields.vector(
        "right_in_sensor", tracker.registration.right_in_sensor, {-1.0, 1.0, ""},
        "for such a device, stereo: direction from the left eye to the right one, in the axes of the "
        "sensor on the head; `frustumscreen-calibrate eye --from` tells it");
    fields.require("settings.right_in_sensor",
                   glm::length(tracker.registration.right_in_sensor) >= shortest_direction, "right_in_sensor",
                   "gives no direction; allowed are three numbers of which one is not 0");
    fields.number("display_latency_ms", tracker.display_latency_ms, {0.0, 200.0, "milliseconds"},
                  "time from a page flip until its picture is lit; poses are predicted to that time");
}

void calibration_settings(auto& fields, auto& calibration) {
    fields.path("folder", calibration.folder,
                "where frustumscreen-calibrate keeps its calibrations; the newest replaces the lens and pose "
                "in [projector] and the registration in [tracker]");
    fields.flag("by_buttons", calibration.by_buttons,
                "the staff may begin a calibration on the page Place of their picture; the picture stays "
                "while none is kept");
    fields.number("sensor_height_m", calibration.sensor_height_m, {-2.0, 2.0, "metres"},
                  "height of the sensor above the prop's bottom, measured with a ruler; 0: as in "
                  "tracker.sensor_from_prop");
    fields.integer("touches", calibration.touches, 6, 30, "how many crosses the prop is laid on");
    fields.number("block_m", calibration.block_m, {0.02, 0.5, "metres"},
                  "how high boards raise the prop for half of the touches; best is the prop's height");
}

void press_settings(auto& fields, auto& press) {
    fields.number("at_s", press.at_s, {0.0, longest_script_s, "seconds"}, "time after the script begins");
    fields.integer("button", press.button, 0, static_cast<int>(button_commands.size()) - 1,
                   "0 previous artifact, 1 next artifact, 2 language, 3 choose, 4 help, 5 behaviour, "
                   "6 window");
}

void panel_settings(auto& fields, auto& panel) {
    fields.choice("kind", panel.kind, panel_names,
                  "scripted: a script of presses; gpio: buttons at a GPIO chip; keys: keys of a separate "
                  "keyboard, for a bench");
    fields.tables(
        "script", panel.script, max_presses, [](auto& item, auto& press) { press_settings(item, press); },
        "scripted: presses, in the order of their times");
    fields.number("repeat_s", panel.repeat_s, {0.0, longest_script_s, "seconds"},
                  "scripted: the script begins again after this long; 0: it runs once");
    fields.text("chip", panel.chip, "gpio: path, name, label or number; gpiodetect lists them");
    fields.texts("lines", panel.lines, button_commands.size(),
                 "gpio: names or offsets of buttons 0, 1, ...; gpioinfo lists them");
    fields.choice("bias", panel.bias, bias_names, "gpio: what holds a line while its button is up");
    fields.flag("active_low", panel.active_low, "gpio: a pressed button pulls its line to ground");
    fields.texts("lamps", panel.lamps, button_commands.size(),
                 "gpio: lines that light the buttons, in the same order; may be fewer");
    fields.text("device", panel.device, "keys: path or name of the keyboard's event device");
    fields.texts("keys", panel.keys, button_commands.size(), "keys: KEY_... of buttons 0, 1, ...");
    fields.number("debounce_ms", panel.debounce_ms, {1.0, 500.0, "milliseconds"},
                  "gpio, keys: how long a level must stay to count");
    fields.number("stuck_s", panel.stuck_s, {5.0, 3600.0, "seconds"},
                  "gpio, keys: a button that is down for longer is ignored until it is released");
}

void tag_settings(auto& fields, auto& tag) {
    fields.integer("id", tag.id, 0, 586, "number in the family 36h11");
    fields.number("size_m", tag.size_m, {0.005, 0.5, "metres"}, "side of the black square");
    fields.vector("centre_m", tag.centre_m, {-1.0, 1.0, "metres"},
                  "its middle, from the middle of the prop's bottom");
    fields.number("turn_deg", tag.turn_deg, {-360.0, 360.0, "degrees"},
                  "0: its top looks to the prop's +Y; counter-clockwise seen from above");
    fields.number("lean_deg", tag.lean_deg, {-180.0, 180.0, "degrees"},
                  "0: it lies face up; 90: it stands upright; before it is turned");
}

template <typename Fields> void camera_lens_settings(Fields& fields, auto& camera) {
    auto& pinhole = camera.pinhole;
    fields.number("fx", pinhole.fx, {0.0, 200000.0, "pixels"},
                  "focal length along the rows, at width and height; 0: not measured");
    if constexpr (Fields::reads) {
        pinhole.width = camera.width;
        pinhole.height = camera.height;
        pinhole.fy = pinhole.fx;
        pinhole.cx = 0.5 * camera.width;
        pinhole.cy = 0.5 * camera.height;
    }
    fields.number("fy", pinhole.fy, {0.0, 200000.0, "pixels"}, "along the columns; left out: fx");
    fields.number("cx", pinhole.cx, {0.0, 1.0 * pinhole.width, "pixels"},
                  "column of the optical axis; left out: the frame's middle");
    fields.number("cy", pinhole.cy, {0.0, 1.0 * pinhole.height, "pixels"},
                  "row of the optical axis; left out: the frame's middle");
    distortion_settings(fields, pinhole.lens);
    fields.rigid("table_from_camera", camera.table_from_camera, near_the_table,
                 "where the camera is: 16 numbers, column by column; left out: not measured");
}

void camera_settings(auto& fields, auto& camera) {
    fields.choice(
        "kind", camera.kind, camera_names,
        "v4l2: a camera at USB, or another that the kernel has a driver for. Its frames are never kept");
    fields.text("device", camera.device,
                "\"any\": the first that can be read; or a path such as \"/dev/video0\"; or a name that "
                "frustumscreen camera prints");
    fields.integer("width", camera.width, 16, 8192,
                   "columns; the nearest size that the camera offers is used");
    fields.integer("height", camera.height, 16, 8192, "rows");
    fields.number("rate_hz", camera.rate_hz, {1.0, 240.0, "hertz"}, "frames a second");
    fields.number(
        "exposure_ms", camera.exposure_ms, {0.0, 1000.0, "milliseconds"},
        "0: the camera's own; it is always locked, so that the picture on the table does not change it");
    fields.integer("gain", camera.gain, -1, 65535, "in the camera's own steps; -1: the camera's own");
    fields.integer("white_balance_k", camera.white_balance_k, 0, 10000, "kelvin; 0: the camera's own");
    fields.number("rolling_shutter_ms", camera.rolling_shutter_ms, {0.0, 1000.0, "milliseconds"},
                  "time from the first row that it reads to the last, from its data sheet; corrects the tags "
                  "of a prop that moves. 0: it reads all rows at once (a global shutter)");
    fields.flag("tags", camera.tags,
                "reads tags on the prop, which take over while the tracker is lost or metal is near");
    fields.flag("visitor", camera.visitor,
                "finds the visitor's eye, with nothing on the head: while no sensor reports the head, the "
                "picture turns to the person nearest to the prop");
    fields.flag("drift", camera.drift,
                "checks with drift marks whether the picture lies where it was calibrated, while no visitor "
                "is present");
    camera_lens_settings(fields, camera);
    fields.tables(
        "tag", camera.tag, max_tags, [](auto& item, auto& tag) { tag_settings(item, tag); },
        "the tags on the prop");
}

template <typename Fields> void key_settings(Fields& fields, auto& key) {
    fields.text("name", key.name, "name of the key, for messages");
    fields.parsed(
        "public_key", key.key,
        [](const pack::PublicKey& value) {
            return value == pack::PublicKey{} ? std::string() : pack::public_key_line(value);
        },
        pack::parse_public_key, allowed_public_keys,
        "the second line of NAME.pub, which frustumscreen-pack keygen writes");
    fields.parsed(
        "until", key.until,
        [](const std::optional<std::chrono::sys_days>& day) {
            return day ? text_of_day(*day) : std::string();
        },
        [](std::string_view text) -> std::optional<std::optional<std::chrono::sys_days>> {
            const std::optional<std::chrono::sys_days> day = parse_day(text);
            if (!day && !text.empty()) {
                return std::nullopt;
            }
            return std::make_optional<std::optional<std::chrono::sys_days>>(day); // left out, it does not end
        },
        allowed_last_days, "the key's last day, by the kiosk's clock; left out: it has no end");
    fields.require("settings.key_name", !key.name.empty(), "name",
                   "is left out; allowed is a text that names whose key it is");
}

template <typename Fields> void exhibit_settings(Fields& fields, auto& exhibit) {
    fields.paths("packs", exhibit.packs, max_packs, "shown in this order");
    if constexpr (Fields::reads) {
        exhibit.packs_key = exhibit.packs.empty() ? "" : fields.place("packs");
    }
    fields.path("library", exhibit.library,
                "where packs from sticks are installed; a set there is shown instead of `packs`");
    fields.path("counts", exhibit.counts,
                "folder of the counts of visits ([counts.md](counts.md)); a folder that does not exist, such "
                "as `off`: nothing is counted");
    fields.parsed("language", exhibit.language, std::identity(), parse_language_tag, allowed_language_tags,
                  "first language of the captions");
    fields.flag("captions", exhibit.captions, "captions stand on the table beside the prop");
    fields.number("caption_height_m", exhibit.caption_height_m, {0.002, 0.2, "metres"},
                  "height of a letter's em on the table; 24 pt are 0.0085 m");
    fields.number("caption_brightness", exhibit.caption_brightness, {0.01, 1.0, "of the projector's light"},
                  "brightness of captions; the artifact should be the brightest thing on the table");
    fields.flag("zone_frame", exhibit.zone_frame,
                "a frame of light on the table shows where the prop is lit, when it leaves these places or "
                "is lifted");
    fields.flag("guidance", exhibit.guidance,
                "signs, texts and speech say what to do when a visitor sees a dark face");
    fields.path("words", exhibit.words,
                "the exhibit's own words, from frustumscreen-bake --words; left out: signs without words");
    fields.flag("table_pictures", exhibit.table_pictures,
                "the artifacts lie on the table as small pictures, to choose from");
    fields.number(
        "rest_s", exhibit.rest_s, {10.0, 3600.0, "seconds"},
        "time without a visitor after which the artifacts are shown in turn, in the first language");
    fields.integer(
        "memory_mb", exhibit.memory_mb, 16, 65536,
        "memory for loaded artifacts, in 10^6 bytes; the least recently shown is unloaded first; with a "
        "screen, half of it is the room's");
    fields.tables(
        "keys", exhibit.keys, pack::max_trusted_keys, [](auto& item, auto& key) { key_settings(item, key); },
        "the museum's public keys: what comes on a stick must be signed with one of them");
    fields.choice(
        "unsigned", exhibit.unsigned_packs, unsigned_names,
        "packs from a stick without a signature; \"allow\" is for a bench, and the staff's picture says so");
    fields.path(
        "import_report", exhibit.import_report,
        "the file in which frustumscreen-import reports what it does with a stick; the table shows it");
}

void hour_settings(auto& fields, auto& hour) {
    fields.number("from_h", hour.from_h, {0.0, 23.99, "hours"}, "first hour of the local day for this row");
    fields.number("gain_db", hour.gain_db, sound_gain, "added to the volume until the next row's hour");
}

void sound_settings(auto& fields, auto& sound) {
    fields.choice("kind", sound.kind, sound_names, "none: captions alone");
    fields.text("device", sound.device, "alsa: the sound card's name; aplay -L lists them");
    fields.number("gain_db", sound.gain_db, sound_gain, "volume; 0: as the words were recorded");
    fields.tables(
        "hours", sound.hours, max_hours, [](auto& item, auto& hour) { hour_settings(item, hour); },
        "volume by the hour, such as quieter at night; in the order of the hours, and the last row holds "
        "over midnight");
}

void hours_settings(auto& fields, auto& hours) {
    for (std::size_t day = 0; day < weekday_names.size(); ++day) {
        fields.parsed_list(weekday_names[day], hours.weekdays[day], max_spans, text_of_span, parse_open_span,
                           allowed_spans,
                           day == 0 ? "when the exhibit is awake; []: not at all" : "the same");
    }
    fields.parsed_list(
        "exceptions", hours.exceptions, max_exceptions, text_of_exception, parse_hours_exception,
        allowed_exceptions,
        "days with other times than the weekday's; several entries for one day count together");
    fields.parsed("time_zone", hours.time_zone, std::identity(), parse_time_zone, allowed_time_zones,
                  "time zone of these times; left out: the machine's own");
}

void all_settings(auto& file, auto& settings) {
    const auto table = [&file](const char* name, const char* sentence, const auto& describe) {
        file.table(name, sentence, describe);
    };
    table("projector", "The projector's lens, and where it is.",
          [&](auto& fields) { projector_settings(fields, settings.projector); });
    table("display", "How the picture comes to the projector.",
          [&](auto& fields) { display_settings(fields, settings.display); });
    table("render", "How well an artifact is drawn.",
          [&](auto& fields) { render_settings(fields, settings.render); });
    table("prop", "The white solid on the table or in the hand.",
          [&](auto& fields) { prop_settings(fields, settings.prop); });
    table("table", "The table's top.", [&](auto& fields) { table_settings(fields, settings.table); });
    table("eye", "Where visitors' eyes are.", [&](auto& fields) { eye_settings(fields, settings.eye); });
    table("screen", "A flat screen behind the table, and the room in it.",
          [&](auto& fields) { screen_settings(fields, settings.screen); });
    table("torch", "A lamp in the hand that throws information onto the artifact ([torch.md](torch.md)).",
          [&](auto& fields) { torch_settings(fields, settings.torch); });
    table("windows",
          "Windows that visitors pin onto the table: each keeps what was seen through the prop "
          "([windows.md](windows.md)).",
          [&](auto& fields) { window_settings(fields, settings.windows); });
    table("tracker", "The tracker of the prop, of the visitor's head and of the torch.",
          [&](auto& fields) { tracker_settings(fields, settings.tracker); });
    table("calibration", "The measured projector and tracker.",
          [&](auto& fields) { calibration_settings(fields, settings.calibration); });
    table("panel", "The buttons.", [&](auto& fields) { panel_settings(fields, settings.panel); });
    table("camera", "The camera above the table.",
          [&](auto& fields) { camera_settings(fields, settings.camera); });
    table("exhibit", "The exhibit's pictures and words.",
          [&](auto& fields) { exhibit_settings(fields, settings.exhibit); });
    table("sound", "Speech and its volume.", [&](auto& fields) { sound_settings(fields, settings.sound); });
    table(
        "hours",
        "When the exhibit is awake. Outside of these times the projector is dark and the sound off, until a "
        "button is pressed.",
        [&](auto& fields) { hours_settings(fields, settings.hours); });
}

} // namespace frustumscreen::settings
