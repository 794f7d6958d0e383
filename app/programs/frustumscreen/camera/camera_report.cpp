#include "app/programs/frustumscreen/camera/camera_report.h"

#include "firmware_host/base/json.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::programs {

namespace {

using Json = nlohmann::ordered_json;

std::string mode_text(const camera::CameraMode& mode) {
    const std::string rate =
        mode.rate_hz > 0.0 ? fmt::format(" at {:.4g} Hz", mode.rate_hz) : " at an unknown rate";
    return fmt::format("{} {} x {}{}", camera::name_of(mode.format), mode.width, mode.height, rate);
}

std::string found_text(const camera::FoundCamera& camera) {
    const auto largest = std::max_element(camera.modes.begin(), camera.modes.end(),
                                          [](const camera::CameraMode& a, const camera::CameraMode& b) {
                                              return a.width * a.height < b.width * b.height;
                                          });
    const std::string modes =
        largest == camera.modes.end()
            ? "sends no format that can be read"
            : fmt::format("{} modes, the largest {}", camera.modes.size(), mode_text(*largest));
    return fmt::format("{}: \"{}\" at {}; {}", camera.path, camera.name, camera.bus, modes);
}

std::string control_text(const camera::LockedControl& control) {
    return control.lock == camera::Lock::NotThere
               ? std::string(camera::name_of(control.lock))
               : fmt::format("{:.6g}{}{}, {}", control.value, control.unit.empty() ? "" : " ", control.unit,
                             camera::name_of(control.lock));
}

void add(std::string& text, std::string_view name, const std::string& what) {
    text += fmt::format("{:<15}{}\n", name, what);
}

Json json_of(const camera::CameraMode& mode) {
    return {{"format", camera::name_of(mode.format)},
            {"width", mode.width},
            {"height", mode.height},
            {"rate_hz", mode.rate_hz}};
}

Json json_of(const camera::CameraSetUp& set_up) {
    Json controls = Json::array();
    for (const camera::LockedControl& control : set_up.controls) {
        controls.push_back({{"name", control.name},
                            {"lock", camera::name_of(control.lock)},
                            {"value", control.value},
                            {"unit", control.unit}});
    }
    return {{"path", set_up.path},
            {"name", set_up.name},
            {"bus", set_up.bus},
            {"mode", json_of(set_up.mode)},
            {"controls", controls}};
}

} // namespace

std::string camera_text(const CameraReport& report, const settings::CameraSettings& requested) {
    std::string text;
    for (const camera::FoundCamera& camera : report.found) {
        add(text, "found", found_text(camera));
    }
    if (report.found.empty()) {
        add(text, "found", "no camera");
    }
    if (!report.is_on) {
        return text + "The settings have no camera: camera.kind is \"none\".\n";
    }
    if (report.set_up) {
        add(text, "taken", fmt::format("{}: \"{}\"", report.set_up->path, report.set_up->name));
        add(text, "mode",
            fmt::format("{}; the settings ask for {} x {} at {:.4g} Hz", mode_text(report.set_up->mode),
                        requested.width, requested.height, requested.rate_hz));
        for (const camera::LockedControl& control : report.set_up->controls) {
            add(text, control.name, control_text(control));
        }
    }
    const camera::CameraCounts& counts = report.counts;
    add(text, "frames",
        fmt::format("{} in {:.1f} s, {:.1f} a second of late; {} lost, {} broken, {} overtaken",
                    counts.frames, report.seconds, report.rate_hz, counts.lost, counts.broken,
                    counts.overtaken));
    if (report.last_look) {
        const camera::FrameLook& look = *report.last_look;
        add(text, "brightness",
            fmt::format("darkest {}, median {}, brightest {} of 255", look.darkest, look.median,
                        look.brightest));
    }
    return text + fmt::format("{}: {}\n", camera::name_of(camera::health_of(report.state)),
                              camera::sentence_of(report.state));
}

std::string camera_json(const CameraReport& report) {
    Json found = Json::array();
    for (const camera::FoundCamera& camera : report.found) {
        Json modes = Json::array();
        for (const camera::CameraMode& mode : camera.modes) {
            modes.push_back(json_of(mode));
        }
        found.push_back(
            {{"path", camera.path}, {"name", camera.name}, {"bus", camera.bus}, {"modes", modes}});
    }
    Json json{{"found", found}, {"on", report.is_on}};
    if (report.is_on) {
        Json changes = Json::array();
        for (const CameraChange& change : report.changes) {
            changes.push_back({{"at_s", to_seconds(change.at.time_since_epoch())},
                               {"after_s", to_seconds(change.at - report.begun)},
                               {"health", camera::name_of(camera::health_of(change.state))},
                               {"sentence", camera::sentence_of(change.state)}});
        }
        json["health"] = camera::name_of(camera::health_of(report.state));
        json["sentence"] = camera::sentence_of(report.state);
        json["set_up"] = report.set_up ? json_of(*report.set_up) : Json();
        json["seconds"] = report.seconds;
        json["rate_hz"] = report.rate_hz;
        json["counts"] = {{"connections", report.counts.connections},
                          {"frames", report.counts.frames},
                          {"overtaken", report.counts.overtaken},
                          {"lost", report.counts.lost},
                          {"broken", report.counts.broken}};
        if (report.last_look) {
            json["brightness"] = {{"darkest", report.last_look->darkest},
                                  {"median", report.last_look->median},
                                  {"brightest", report.last_look->brightest}};
        }
        json["changes"] = changes;
    }
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; // camera names may be any bytes
}

} // namespace frustumscreen::programs
