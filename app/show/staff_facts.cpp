#include "app/show/staff_facts.h"

#include "app/scene/stereo.h"
#include "app/settings/command.h"
#include "app/show/viewfinder_panel.h"
#include "app/status/exhibit_verdict.h"
#include "app/status/status_card.h"
#include "app/status/status_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>

namespace frustumscreen::show {

namespace {

constexpr const char* calibration_name = "calibration in use";

/// The verdict as other programs judge it.
std::string verdict(const RunStatus& status) {
    status::KnownExhibit known;
    known.status.fields = nlohmann::json::parse(status::status_json(status), nullptr, false);
    known.status.age_s = 0.0;
    if (status.environment) {
        known.environment = *status.environment;
    }
    return status::verdict_of(known).sentence;
}

/// Days since "2026-11-25 10:12 UTC"; nothing: there is no date, or it is in the future.
std::optional<int> age_days(const std::string& made, std::time_t now) {
    std::tm day{};
    if (std::sscanf(made.c_str(), "%4d-%2d-%2d", &day.tm_year, &day.tm_mon, &day.tm_mday) != 3) {
        return std::nullopt;
    }
    const std::chrono::year_month_day date{std::chrono::year(day.tm_year),
                                           std::chrono::month(static_cast<unsigned>(day.tm_mon)),
                                           std::chrono::day(static_cast<unsigned>(day.tm_mday))};
    if (!date.ok()) {
        return std::nullopt;
    }
    const auto today = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::from_time_t(now));
    const auto days = (today - std::chrono::sys_days(date)).count();
    return days >= 0 ? std::optional(static_cast<int>(days)) : std::nullopt;
}

std::string named(const char* name, std::string_view text) {
    return text.empty() ? std::string() : fmt::format("{}: {}", name, text);
}

} // namespace

std::string calibration_line(const settings::CalibrationSettings& settings, std::time_t now) {
    if (!settings.used) {
        return "none; projector and tracker stand as the settings say";
    }
    const settings::Calibration& used = *settings.used;
    const std::optional<int> days = age_days(used.made, now);
    return fmt::format(
        "{}, made {}{}, with {} places ({}); {:.1f} mm on average, {:.1f} mm at the worst of them",
        settings.used_name, used.made, days ? fmt::format(", {} days ago", *days) : std::string(),
        used.places, settings::name_of(used.method), used.mean_mm, used.worst_mm);
}

StaffFacts staff_facts(const RunStatus& status, const settings::Settings& settings, std::string_view driver,
                       exhibit::State before, std::time_t now) {
    StaffFacts facts;
    std::vector<status::StatusLine> lines = status::status_lines(&status, 0.0, status.environment.get(), now);
    const std::string calibration = calibration_line(settings.calibration, now);
    const auto after = std::find_if(lines.begin(), lines.end(), [](const status::StatusLine& line) {
        return line.name == "calibration" || line.name == "buttons";
    });
    lines.insert(after, {calibration_name, calibration, true});
    const std::string judged = verdict(status);
    facts.lines = {judged};
    if (settings.exhibit.unsigned_packs == pack::UnsignedPacks::Allow) {
        facts.lines.emplace_back("unsigned packs are allowed: for the bench only");
    }
    for (const status::StatusLine& line : lines) {
        if (line.for_staff) {
            facts.lines.push_back(line.name.empty() ? line.text
                                                    : fmt::format("{}: {}", line.name, line.text));
        }
    }
    facts.lines.push_back(
        fmt::format("OpenGL: {}; before this picture: {}", driver, exhibit::name_of(before)));
    facts.card = status::status_card(judged, status, lines, now);
    facts.calibration = named(calibration_name, calibration);
    facts.stereo = settings::stereo_of(settings) != settings::Stereo::Off;
    facts.measures_pixels = scene::keeps_pixels(settings::stereo_of(settings));
    facts.drift = named("calibration", status.drift.view());
    facts.tracker = named("tracker", status.tracker.view().empty() ? "there is none" : status.tracker.view());
    facts.camera =
        status.camera.view().empty() ? std::string() : fmt::format("camera: {}", viewfinder_line(status));
    facts.panel = named("buttons", status.panel.view());
    facts.sound = named("sound", status.sound.view());
    facts.buttons = std::clamp<std::size_t>(settings.panel.buttons(), 2, settings::button_commands.size());
    facts.tracks_head = settings.eye.tracked;
    facts.calibrates = status.calibrates;
    facts.copies = status.copies;
    return facts;
}

} // namespace frustumscreen::show
