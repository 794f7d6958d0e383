// Draws the staff's picture of an exhibit that runs well, for the guide: the exhibit's own pattern, and its lines of an example.
//
//   draw_staff_picture OUT.png

#include "app/image/image.h"
#include "app/settings/settings.h"
#include "app/status/status_lines.h"
#include "app/typography/pattern.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>

#include <cstdio>

namespace frustumscreen {
namespace {

/// As a kiosk's status file has it (docs/status.md).
constexpr const char* status = R"({
 "versions": {"program": "0.1.0", "pack_format": 2, "system": "Debian GNU/Linux 12 (bookworm), Linux 6.1.0"},
 "health": "well", "state": "staff", "artifact": "Amphora", "language": "en", "shown_for_s": 7500,
 "level": "level1", "technique": "auto", "samples": 4, "estimated_error_mm": 0.25,
 "frame_ms": {"p50": 8.5, "p95": 14.0, "p99": 15.9}, "missed_deadlines": 2, "drawn": 41200, "skipped": 0,
 "display": "the projector at HDMI-A-1 is lit, 1280 x 800 at 60 Hz",
 "tracker": "the tracker is running", "prop_known": true, "head_known": false,
 "panel": "its buttons are there", "sound": "its sound goes to plughw:CARD=PCH,DEV=0",
 "set": {"number": 3, "packs": [{"title": "Amphora"}, {"title": "Nautilus cup"}], "newest": {"number": 3, "verdict": "good"},
         "trouble": ""},
 "tracker_counts": {"frames": 2160000, "lost": 3, "broken": 0, "connections": 1}, "device_errors": 0,
 "uptime_s": 36000, "resident_mib": 197})";
constexpr const char* watchdog = R"({
 "mode": "normal", "trouble": null, "step": null, "reboots_today": 0, "notes": ["the computer has 88 degrees Celsius; give it air"],
 "faults": [{"at": "2026-05-01T09:30:00Z", "awake_s": 5, "sentence": "the tracker is plugged in and says nothing",
             "done": "the tracker's USB port is switched off and on", "helped": true}]})";

Result<Image8> picture() {
    const Result<CheckedSettings> settings =
        parse_settings("[projector]\nwidth = 1280\nheight = 800\n", "kiosk.toml");
    Result<Typesetter> typesetter = Typesetter::open();
    if (!settings || !typesetter) {
        return tl::unexpected<Error>(!settings ? settings.error() : typesetter.error());
    }
    Surroundings around;
    around.watchdog.fields = nlohmann::json::parse(watchdog);
    around.watchdog.age_s = 0.0;
    std::vector<std::string> lines;
    constexpr std::time_t now = 1777651200; // a Friday at noon
    const StatusReport report = read_status_report(nlohmann::json::parse(status));
    for (const StatusLine& line : status_lines(&report, 0.0, &around, now)) {
        if (line.for_staff) {
            lines.push_back(line.name.empty() ? line.text : fmt::format("{}: {}", line.name, line.text));
        }
    }
    const Settings& all = **settings;
    const PatternScene scene{all.projector.pinhole,
                             all.projector.table_from_projector,
                             {all.table.width_m, all.table.depth_m},
                             make_prop(all.prop)};
    const RigidTransform table_from_prop{glm::angleAxis(0.35, glm::dvec3(0.0, 0.0, 1.0)), {0.12, -0.02, 0.0}};
    return with_lines(with_prop(table_pattern(scene, *typesetter), scene, table_from_prop, *typesetter),
                      lines, *typesetter);
}

} // namespace
} // namespace frustumscreen

int main(int argc, char** argv) {
    using namespace frustumscreen;
    if (argc != 2) {
        fmt::print(stderr, "usage: draw_staff_picture OUT.png\n");
        return 2;
    }
    const Result<Image8> drawn = picture();
    const Result<void> written =
        drawn ? write_file(argv[1], encode_png(*drawn)) : tl::unexpected<Error>(drawn.error());
    if (!written) {
        fmt::print(stderr, "draw_staff_picture: {}\n", written.error().message);
    }
    return written ? 0 : 1;
}
