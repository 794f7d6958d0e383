#include "app/status/exhibit_lines.h"

#include "app/exhibit/states.h"
#include "firmware_host/base/words_of_time.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::status {

namespace {

constexpr std::size_t max_titles = 6;

/// The time of day `ago_s` before now, with the date if that was another day. Empty: the time is impossible.
std::string day_time(std::time_t now, double ago_s) {
    const std::time_t then = now - static_cast<std::time_t>(std::clamp(ago_s, 0.0, 1e9));
    if (now < 0 || then < 0) {
        return {};
    }
    const std::tm local = fmt::localtime(then);
    const std::tm today = fmt::localtime(now);
    const bool same_day = local.tm_year == today.tm_year && local.tm_yday == today.tm_yday;
    return same_day ? fmt::format("{:%H:%M}", local) : fmt::format("{:%Y-%m-%d %H:%M}", local);
}

std::string screen_line(const StatusReport& status, std::optional<double> age_s, std::time_t now) {
    const bool has_artifact = !status.artifact.empty();
    std::string what = has_artifact ? fmt::format("\"{}\"", brief(status.artifact)) : "no artifact";
    if (has_artifact && !status.language.empty()) {
        what += fmt::format(" ({})", status.language);
    }
    if (status.state == exhibit::name_of(exhibit::State::Staff)) {
        what = has_artifact ? "the alignment pattern, over " + what : "the alignment pattern";
    }
    if (status.shown_for_s) {
        const double since_s = *status.shown_for_s + age_s.value_or(0.0);
        what += ", for " + words_of_time(since_s) + (age_s ? ", since " + day_time(now, since_s) : "");
    }
    return what;
}

std::string state_line(const StatusReport& status) {
    const auto* const note =
        std::find_if(exhibit::state_notes.begin(), exhibit::state_notes.end(),
                     [&](const exhibit::StateNote& each) { return each.name == status.state; });
    return note != exhibit::state_notes.end() ? fmt::format("{}: {}", status.state, note->shows)
                                              : status.state;
}

std::string picture_line(const StatusReport& status) {
    const std::optional<double>& error_mm = status.estimated_error_mm;
    return status.level.empty()
               ? std::string()
               : fmt::format(
                     "{} ({}), {} a pixel{}", status.level, or_else(status.technique, "?"),
                     counted(static_cast<std::uint64_t>(std::max(status.samples, 0)), "sample", "samples"),
                     error_mm ? fmt::format(", {:.2f} mm from the scan on average", *error_mm)
                              : std::string());
}

std::string frames_line(const StatusReport& status) {
    const FrameQuantiles& times = status.frame_ms;
    if (!times.p50 || !times.p99 || status.drawn == 0) {
        return {};
    }
    return fmt::format(
        "median {:.1f} ms, 99 % within {:.1f} ms; {} of {} pictures took longer than a refresh; {} missed",
        *times.p50, *times.p99, status.missed_deadlines, status.drawn,
        counted(status.skipped, "display time", "display times"));
}

std::string errors_line(const StatusReport& status) {
    const tracker::TrackerCounts& tracker = status.tracker_counts;
    std::string text = counted(status.device_errors, "error of a device", "errors of devices");
    if (tracker.frames > 0) {
        text += fmt::format("; tracker: {} of {} samples lost, {} broken, opened {}", tracker.lost,
                            tracker.frames, tracker.broken, counted(tracker.connections, "time", "times"));
    }
    if (status.sound_underruns > 0) {
        text += fmt::format("; sound: {}", counted(status.sound_underruns, "gap", "gaps"));
    }
    return text;
}

std::string places_line(const StatusReport& status) {
    const auto word = [](bool known) { return known ? "known" : "not known"; };
    return fmt::format("the prop's place is {}, the visitor's head is {}", word(status.prop_known),
                       status.eye_by == "camera" ? "seen by the camera" : word(status.head_known));
}

/// Empty without a torch.
std::string torch_line(const StatusReport& status) {
    if (!status.torch) {
        return {};
    }
    const TorchReport& torch = *status.torch;
    const std::string by = torch.by.empty() ? std::string() : " (" + brief(torch.by) + ")";
    const std::string throws = torch.content.empty() ? std::string() : ", throws " + brief(torch.content);
    return brief(torch.state) + by + throws;
}

std::string camera_line(const StatusReport& status) {
    return status.camera.view().empty()
               ? std::string()
               : fmt::format("{}; {:.0f} frames a second, for {}", status.camera.view(), status.camera_hz,
                             or_else(status.camera_for, "nothing"));
}

std::string visits_line(const StatusReport& status) {
    if (!status.visits) {
        return {};
    }
    const VisitsReport& visits = *status.visits;
    std::string text = fmt::format("today {}, {:.0f} minutes in all",
                                   counted(visits.today, "visit", "visits"), visits.today_s / 60.0);
    return visits.trouble.empty() ? text : text + "; " + brief(visits.trouble);
}

std::string set_line(const StatusReport& status) {
    if (!status.set) {
        return "the packs of the settings";
    }
    const SetStatus& set = *status.set;
    std::string text = set.shown == 0 ? "the packs of the settings" : fmt::format("set {}", set.shown);
    std::string titles;
    for (std::size_t k = 0; k < std::min(set.packs.size(), max_titles); ++k) {
        titles += fmt::format("{}{}", k == 0 ? "" : ", ", or_else(set.packs[k].title, "?"));
    }
    if (!titles.empty()) {
        text += fmt::format(", {}: {}{}", counted(set.packs.size(), "pack", "packs"), titles,
                            set.packs.size() > max_titles ? ", ..." : "");
    }
    if (const library::SetVerdict& newest = set.newest; newest.number != 0) {
        text += fmt::format("; the newest is set {}, {}{}{}", newest.number,
                            library::trial_state_names.at(static_cast<std::size_t>(newest.state)),
                            newest.reason.empty() ? "" : ": ", brief(newest.reason));
    }
    const std::string trouble = trouble_of(set, status.library_hangs);
    return trouble.empty() ? text : text + "; " + brief(trouble);
}

std::string signatures_line(const StatusReport& status) {
    return !status.set || status.set->of_ended_keys.empty()
               ? std::string()
               : "packs of a key that is no longer trusted: " + brief(status.set->of_ended_keys);
}

std::string left_out_line(const StatusReport& status) {
    if (!status.left_out) {
        return {};
    }
    const std::vector<library::UnshownPack>& packs = *status.left_out;
    std::string text;
    for (std::size_t k = 0; k < std::min(packs.size(), max_told); ++k) {
        text += fmt::format("{}{}: {}", k == 0 ? "" : "; ", brief(packs[k].pack), brief(packs[k].reason));
    }
    return packs.size() > max_told ? fmt::format("{}; and {} more", text, packs.size() - max_told) : text;
}

std::string stick_line(const StatusReport& status) {
    if (!status.import) {
        return "none since the machine was started";
    }
    const library::ImportReport& import = *status.import;
    const auto refused =
        std::count_if(import.packs.begin(), import.packs.end(), [](const library::ImportedPack& pack) {
            return pack.outcome == library::ImportOutcome::Refused;
        });
    return fmt::format("\"{}\": {}{}{}; {}, {} refused", brief(import.stick),
                       library::import_stage_names.at(static_cast<std::size_t>(import.stage)),
                       import.reason.empty() ? "" : ": ", brief(import.reason),
                       counted(import.packs.size(), "pack", "packs"), refused);
}

/// Empty without a screen.
std::string screen_output_line(const StatusReport& status) {
    if (!status.screen_picture) {
        return {};
    }
    const ScreenReport& screen = *status.screen_picture;
    return fmt::format("{}; {} pictures presented, {} of them drawn, 95 % within {:.1f} ms",
                       or_else(status.screen.view(), "drawn, on no screen"), screen.presented, screen.drawn,
                       screen.frame_ms.p95.value_or(0.0));
}

} // namespace

void add_exhibit(Lines& lines, const StatusReport& status, std::optional<double> age_s, std::time_t now) {
    lines.add("on the screen", screen_line(status, age_s, now));
    lines.add("state", state_line(status), false);
    lines.add("picture", picture_line(status));
    lines.add("frame times", frames_line(status));
    lines.add("projector", or_else(status.display.view(), "nothing to say"));
    lines.add("screen", screen_output_line(status));
    lines.add("tracker", or_else(status.tracker.view(), "there is none"));
    lines.add("places", places_line(status));
    lines.add("torch", torch_line(status));
    lines.add("camera", camera_line(status));
    lines.add("calibration", status.drift.view());
    lines.add("buttons", or_else(status.panel.view(), "there are none"));
    lines.add("sound", or_else(status.sound.view(), "nothing to say"));
    lines.add("recording", status.recording.view());
    lines.add("visitors", visits_line(status));
    lines.add("packs", set_line(status));
    lines.add("signatures", signatures_line(status));
    lines.add("left out", left_out_line(status));
    lines.add("stick", stick_line(status), false);
    lines.add("errors", errors_line(status));
}

} // namespace frustumscreen::status
