// Draws, for the guide, the staff's picture of an exhibit that runs well: the exhibit's own pages, with an example of a
// status.
//
//   draw_staff_picture FOLDER      writes staff.png, staff_place.png, and staff_pages.png with the others

#include "app/image/image.h"
#include "app/settings/settings.h"
#include "app/show/staff_picture.h"
#include "app/typography/canvas.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

namespace frustumscreen::tests {
namespace {

/// The contents of a kiosk's status file (docs/status.md).
constexpr const char* status = R"({
 "versions": {"program": "0.1.0", "pack_format": 2, "system": "Debian GNU/Linux 12 (bookworm), Linux 6.1.0"},
 "health": "well", "state": "staff", "artifact": "Amphora", "language": "en", "shown_for_s": 7500,
 "level": "level1", "technique": "auto", "samples": 4, "estimated_error_mm": 0.25,
 "frame_ms": {"p50": 8.5, "p95": 14.0, "p99": 15.9}, "missed_deadlines": 2, "drawn": 41200, "skipped": 0,
 "display": "the projector at HDMI-A-1 is lit, 1280 x 800 at 60 Hz",
 "tracker": "the tracker is running", "prop_known": true, "head_known": false,
 "panel": "its buttons are there", "sound": "its sound goes to plughw:CARD=PCH,DEV=0",
 "set": {"number": 3, "packs": [{"id": "amphora", "title": "Amphora"}, {"id": "nautilus-cup", "title": "Nautilus cup"}],
         "newest": {"number": 3, "verdict": "good"}, "trouble": ""},
 "tracker_counts": {"frames": 2160000, "lost": 3, "broken": 0, "connections": 1}, "device_errors": 0,
 "uptime_s": 36000, "resident_mib": 197})";
constexpr const char* watchdog = R"({
 "mode": "normal", "trouble": null, "step": null, "reboots_today": 0,
 "notes": ["the computer is at 88 degrees Celsius, which is too hot; let air reach it"],
 "faults": [{"at": "2026-05-01T09:30:00Z", "awake_s": 5, "sentence": "the tracker is plugged in but sends nothing",
             "done": "the tracker's USB port is switched off and on", "helped": true}]})";

show::StaffFacts facts_of(const settings::Settings& settings) {
    status::Environment around;
    around.watchdog.fields = nlohmann::json::parse(watchdog);
    around.watchdog.age_s = 0.0;
    show::RunStatus run;
    static_cast<status::StatusReport&>(run) = status::read_status_report(nlohmann::json::parse(status));
    run.environment = std::make_shared<const status::Environment>(around);
    run.calibrates = run.copies = true;
    constexpr std::time_t now = 1777651200; // a Friday at noon
    show::StaffFacts facts =
        show::staff_facts(run, settings, "Mesa Intel(R) UHD Graphics 630", exhibit::State::View, now);
    facts.speaks = true;
    facts.copy.stage = exhibit::CopyStage::Offered;
    facts.settings_gain_db = -3.0;
    facts.prop = {240.0, 1.0, 0.06, 0.012};
    return facts;
}

/// The other pages side by side, at half size.
image::Image8 contact_sheet(const std::vector<image::Image8>& pages) {
    constexpr int gap = 10;
    const glm::ivec2 size(pages.front().width / 2, pages.front().height / 2);
    const int rows = (static_cast<int>(pages.size()) + 1) / 2;
    typography::Canvas sheet(2 * size.x + gap, rows * (size.y + gap) - gap, typography::Colour(255));
    for (std::size_t k = 0; k < pages.size(); ++k) {
        const glm::ivec2 place(static_cast<int>(k % 2), static_cast<int>(k / 2));
        sheet.picture(pages[k], {0.0, 0.0}, {pages[k].width, pages[k].height}, place * (size + gap), size);
    }
    return sheet.take();
}

Result<void> draw(const std::filesystem::path& folder) {
    TRY(const settings::CheckedSettings checked,
        settings::parse_settings(
            "[projector]\nwidth = 1280\nheight = 800\n[panel]\nkind = \"keys\"\ndevice = "
            "\"keyboard\"\nkeys = "
            "[\"KEY_1\", \"KEY_2\", \"KEY_3\"]\n",
            "kiosk.toml"));
    TRY(const typography::Typesetter typesetter, typography::Typesetter::open());
    settings::Settings settings = *checked;
    settings::Calibration used;
    used.made = "2026-04-12 10:12 UTC";
    used.places = 9;
    used.mean_mm = 0.52;
    used.worst_mm = 0.84;
    settings.calibration.used = used;
    settings.calibration.used_name = "calibration-0008.toml";
    const typography::PatternScene scene{settings.projector.pinhole,
                                         settings.projector.table_from_projector,
                                         {settings.table.width_m, settings.table.depth_m},
                                         settings::make_prop(settings.prop)};
    const show::StaffFacts facts = facts_of(settings);
    const auto page = [&](exhibit::StaffPage which, exhibit::StaffLight light = exhibit::StaffLight::White) {
        exhibit::StaffView view;
        view.page = which;
        view.light = light;
        view.louder_db = 6;
        view.copies = which == exhibit::StaffPage::Copy;
        view.presses = {2, 1, 4, 0, 0};
        view.pressed = which == exhibit::StaffPage::Buttons ? std::optional<std::uint8_t>(std::uint8_t{2})
                                                            : std::nullopt;
        return show::staff_picture(view, facts, scene, show::staff_background(view, scene, typesetter),
                                   typesetter);
    };
    const geometry::RigidTransform table_from_prop{glm::angleAxis(0.35, glm::dvec3(0.0, 0.0, 1.0)),
                                                   {0.12, -0.02, 0.0}};
    TRY_VOID(write_file(folder / "staff.png", image::encode_png(page(exhibit::StaffPage::Status))));
    TRY_VOID(write_file(folder / "staff_place.png",
                        image::encode_png(typography::with_prop(page(exhibit::StaffPage::Place), scene,
                                                                table_from_prop, typesetter))));
    return write_file(
        folder / "staff_pages.png",
        image::encode_png(contact_sheet(
            {page(exhibit::StaffPage::Focus), page(exhibit::StaffPage::Light, exhibit::StaffLight::Greys),
             page(exhibit::StaffPage::Sound), page(exhibit::StaffPage::Tracker),
             page(exhibit::StaffPage::Copy), page(exhibit::StaffPage::Buttons)})));
}

} // namespace
} // namespace frustumscreen::tests

int main(int argc, char** argv) {
    using namespace frustumscreen;
    using namespace frustumscreen::tests;
    if (argc != 2) {
        fmt::print(stderr, "usage: draw_staff_picture FOLDER\n");
        return 2;
    }
    const Result<void> drawn = draw(argv[1]);
    if (!drawn) {
        fmt::print(stderr, "draw_staff_picture: {}\n", drawn.error().message);
    }
    return drawn ? 0 : 1;
}
