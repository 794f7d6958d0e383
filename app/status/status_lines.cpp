#include "app/status/status_lines.h"

#include "app/exhibit/states.h"
#include "app/status/exhibit_verdict.h"
#include "app/status/json_fields.h"
#include "firmware_host/base/words_of_time.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace frustumscreen {

namespace {

constexpr std::size_t most_told = 3; ///< faults, and packs that were left out
constexpr std::size_t most_titles = 6;

/// The lines as they grow; a line without a text is left out.
class Lines {
public:
    void add(const char* name, std::string text, bool for_staff = true) {
        if (!text.empty()) {
            lines_.push_back({name, std::move(text), for_staff});
        }
    }
    [[nodiscard]] std::vector<StatusLine> take() { return std::move(lines_); }

private:
    std::vector<StatusLine> lines_;
};

std::uint64_t count_of(const JsonFields& fields, const char* key) {
    return static_cast<std::uint64_t>(std::clamp(fields.number(key).value_or(0.0), 0.0, 1e18));
}

std::string counted(std::uint64_t count, const char* one, const char* many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string or_else(std::string text, const char* otherwise) {
    return text.empty() ? std::string(otherwise) : text;
}

/// The time of day `ago_s` before now; with the date where that was another day. Empty: no such time.
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

std::string screen_line(const JsonFields& status, std::optional<double> age_s, std::time_t now) {
    const std::string state = status.text("state");
    const std::string artifact = status.text("artifact");
    std::string what = artifact.empty() ? "no artifact" : fmt::format("\"{}\"", artifact);
    if (const std::string language = status.text("language"); !artifact.empty() && !language.empty()) {
        what += fmt::format(" ({})", language);
    }
    if (state == name_of(State::Staff)) {
        what = artifact.empty() ? "the alignment pattern" : "the alignment pattern, over " + what;
    }
    if (const std::optional<double> shown_s = status.number("shown_for_s")) {
        const double since_s = *shown_s + age_s.value_or(0.0);
        what += ", for " + words_of_time(since_s) + (age_s ? ", since " + day_time(now, since_s) : "");
    }
    return what;
}

std::string state_line(const JsonFields& status) {
    const std::string name = status.text("state");
    const auto* const note = std::find_if(state_notes.begin(), state_notes.end(),
                                          [&](const StateNote& each) { return each.name == name; });
    return note != state_notes.end() ? fmt::format("{}: {}", name, note->shows) : name;
}

std::string picture_line(const JsonFields& status) {
    const std::string level = status.text("level");
    const std::optional<double> error_mm = status.number("estimated_error_mm");
    return level.empty()
               ? std::string()
               : fmt::format("{} ({}), {} a pixel{}", level, or_else(status.text("technique"), "?"),
                             counted(count_of(status, "samples"), "sample", "samples"),
                             error_mm ? fmt::format(", {:.2f} mm from the scan on average", *error_mm)
                                      : std::string());
}

std::string frames_line(const JsonFields& status) {
    const JsonFields times = status.at("frame_ms");
    const std::optional<double> half = times.number("p50");
    const std::optional<double> most = times.number("p99");
    if (!half || !most || count_of(status, "drawn") == 0) {
        return {};
    }
    return fmt::format(
        "half of the pictures took {:.1f} ms at most, 99 of 100 took {:.1f} ms at most; {} of {} took longer "
        "than a refresh, {} came too late",
        *half, *most, count_of(status, "missed_deadlines"), count_of(status, "drawn"),
        counted(count_of(status, "skipped"), "look", "looks"));
}

std::string errors_line(const JsonFields& status) {
    const JsonFields tracker = status.at("tracker_counts");
    std::string text = counted(count_of(status, "device_errors"), "error of a device", "errors of devices");
    if (const std::uint64_t frames = count_of(tracker, "frames"); frames > 0) {
        text += fmt::format("; tracker: {} of {} samples lost, {} broken, opened {}",
                            count_of(tracker, "lost"), frames, count_of(tracker, "broken"),
                            counted(count_of(tracker, "connections"), "time", "times"));
    }
    if (const std::uint64_t underruns = count_of(status, "sound_underruns"); underruns > 0) {
        text += fmt::format("; sound: {}", counted(underruns, "gap", "gaps"));
    }
    return text;
}

std::string places_line(const JsonFields& status) {
    const auto known = [&](const char* key) {
        return status.flag(key).value_or(false) ? "known" : "not known";
    };
    const bool seen = status.text("eye_by") == "camera";
    return fmt::format("the prop's place is {}, the visitor's head is {}", known("prop_known"),
                       seen ? "seen by the camera" : known("head_known"));
}

std::string camera_line(const JsonFields& status) {
    const std::string state = status.text("camera");
    if (state.empty()) {
        return {};
    }
    const std::string used_for = status.text("camera_for");
    return fmt::format("{}; {:.0f} frames a second, for {}", state, status.number("camera_hz").value_or(0.0),
                       or_else(used_for, "nothing"));
}

std::string set_line(const JsonFields& status) {
    const JsonFields set = status.at("set");
    if (!set.there()) {
        return "the packs of the settings";
    }
    const std::uint64_t number = count_of(set, "number");
    std::string text = number == 0 ? "the packs of the settings" : fmt::format("set {}", number);
    std::string titles;
    const std::vector<JsonFields> packs = set.list("packs");
    for (std::size_t k = 0; k < std::min(packs.size(), most_titles); ++k) {
        titles += fmt::format("{}{}", k == 0 ? "" : ", ", or_else(packs[k].text("title"), "?"));
    }
    if (!titles.empty()) {
        text += fmt::format(", {}: {}{}", counted(packs.size(), "pack", "packs"), titles,
                            packs.size() > most_titles ? ", ..." : "");
    }
    const JsonFields newest = set.at("newest");
    if (const std::uint64_t other = count_of(newest, "number"); other != 0) {
        text += fmt::format("; the newest is set {}, {}{}{}", other, or_else(newest.text("verdict"), "?"),
                            newest.text("reason").empty() ? "" : ": ", newest.text("reason"));
    }
    const std::string trouble = set.text("trouble");
    return trouble.empty() ? text : text + "; " + trouble;
}

std::string left_out_line(const JsonFields& status) {
    const std::vector<JsonFields> packs = status.list("left_out");
    std::string text;
    for (std::size_t k = 0; k < std::min(packs.size(), most_told); ++k) {
        text += fmt::format("{}{}: {}", k == 0 ? "" : "; ", packs[k].text("pack"), packs[k].text("reason"));
    }
    return packs.size() > most_told ? fmt::format("{}; and {} more", text, packs.size() - most_told) : text;
}

std::string stick_line(const JsonFields& status) {
    const JsonFields import = status.at("import");
    if (!import.there()) {
        return "none since the machine was started";
    }
    const std::string reason = import.text("reason");
    std::string text = fmt::format("\"{}\": {}{}{}", import.text("stick"), import.text("stage"),
                                   reason.empty() ? "" : ": ", reason);
    std::size_t refused = 0;
    const std::vector<JsonFields> packs = import.list("packs");
    for (const JsonFields& pack : packs) {
        refused += pack.text("outcome") == "refused" ? 1 : 0;
    }
    return fmt::format("{}; {}, {} refused", text, counted(packs.size(), "pack", "packs"), refused);
}

std::string starts_line(const JsonFields& status, std::optional<double> age_s, const Surroundings& around) {
    std::string text;
    if (const std::optional<double> up_s = status.number("uptime_s")) {
        text =
            fmt::format("it {} for {}; ", age_s ? "runs" : "ran", words_of_time(*up_s + age_s.value_or(0.0)));
    }
    if (!around.ends_trouble.empty()) {
        return text + around.ends_trouble;
    }
    if (!around.ends.last) {
        return text + "it has not ended since the computer was started";
    }
    const ServiceEnd& last = *around.ends.last;
    return fmt::format("{}it has ended {}, last {} ago: {} ({} {})", text,
                       counted(around.ends.count(), "time", "times"),
                       words_of_time(around.monotonic_s - last.monotonic_s),
                       service_results.at(last.result).sentence, last.code, last.exit_status);
}

std::string watchdog_line(const StatusDocument& watchdog) {
    if (watchdog.fields.is_null()) {
        return "nothing is known of it: " + watchdog.why;
    }
    if (!watchdog.fresh()) {
        return watchdog.age_s ? fmt::format("it does not run, or hangs: its status is {} old",
                                            words_of_time(*watchdog.age_s))
                              : std::string("its status does not say when it was written");
    }
    const JsonFields fields(watchdog.fields);
    std::string text(sentence_of_mode(fields.text("mode")));
    if (const JsonFields trouble = fields.at("trouble"); trouble.there()) {
        text += fmt::format("; {} since {}", trouble.text("sentence"),
                            words_of_time(trouble.number("since_s").value_or(0.0)));
    }
    if (const JsonFields step = fields.at("step"); step.there()) {
        text += fmt::format("; tries {} now", step.text("name"));
    }
    return fmt::format("{}; {} of the machine today", text,
                       counted(count_of(fields, "reboots_today"), "restart", "restarts"));
}

std::string fault_line(const JsonFields& fault) {
    std::string text = fmt::format("{} {}", fault.text("at"), or_else(fault.text("sentence"), "?"));
    if (const std::string done = or_else(fault.text("done"), fault.text("step").c_str()); !done.empty()) {
        text += ": " + done;
        if (const std::optional<bool> helped = fault.flag("helped")) {
            text += *helped ? ", which helped" : ", which did not help";
        }
    }
    const std::string detail = fault.text("detail");
    return detail.empty() ? text : fmt::format("{} ({})", text, detail);
}

/// What it sees and does nothing about.
std::string notes_line(const StatusDocument& watchdog) {
    std::string text;
    if (watchdog.fresh()) {
        std::vector<std::string> notes = JsonFields(watchdog.fields).texts("notes");
        notes.resize(std::min(notes.size(), most_told));
        for (const std::string& note : notes) {
            text += (text.empty() ? "" : "; ") + note;
        }
    }
    return text;
}

std::string image_line(const SystemImage& image) {
    if (!image.there()) {
        return {};
    }
    std::string text = fmt::format("version {}, slot {}", image.version, or_else(image.slot, "?"));
    for (const std::string& note : image.notes) {
        text += "; " + note;
    }
    return text;
}

void add_faults(Lines& lines, const StatusDocument& watchdog) {
    if (watchdog.fields.is_null()) {
        return;
    }
    std::vector<JsonFields> faults = JsonFields(watchdog.fields).list("faults");
    if (faults.empty()) {
        lines.add("last faults", "none");
    }
    // The newest one comes first, whichever way the file has them. No one sets the clock that it counts by.
    std::stable_sort(faults.begin(), faults.end(), [](const JsonFields& a, const JsonFields& b) {
        return a.number("awake_s").value_or(0.0) > b.number("awake_s").value_or(0.0);
    });
    for (std::size_t k = 0; k < std::min(faults.size(), most_told); ++k) {
        lines.add(k == 0 ? "last faults" : "", fault_line(faults[k]));
    }
}

void add_crashes(Lines& lines, const std::vector<Crash>& crashes) {
    const char* name = "last crashes";
    for (const Crash& crash : crashes) {
        const std::string driver = crash.driver.empty() ? std::string() : ", " + crash.driver;
        lines.add(name, fmt::format("{:%Y-%m-%dT%H:%M:%SZ} {} (FrustumScreen {}{})",
                                    fmt::gmtime(static_cast<std::time_t>(crash.unix_s)), sentence_of(crash),
                                    crash.program, driver));
        name = "";
    }
}

std::string versions_line(const JsonFields& status, const std::string& system) {
    const JsonFields versions = status.at("versions");
    return versions.there()
               ? fmt::format("FrustumScreen {}, packs of format {}, {}",
                             or_else(versions.text("program"), "?"), count_of(versions, "pack_format"),
                             or_else(versions.text("system"), "?"))
               : fmt::format("FrustumScreen {}, {}", FRUSTUMSCREEN_VERSION, system);
}

void add_exhibit(Lines& lines, const JsonFields& status, std::optional<double> age_s, std::time_t now) {
    lines.add("on the screen", screen_line(status, age_s, now));
    lines.add("state", state_line(status), false);
    lines.add("picture", picture_line(status));
    lines.add("frame times", frames_line(status));
    lines.add("projector", or_else(status.text("display"), "nothing to say"));
    lines.add("tracker", or_else(status.text("tracker"), "there is none"));
    lines.add("places", places_line(status));
    lines.add("camera", camera_line(status));
    lines.add("calibration", status.text("drift"));
    lines.add("buttons", or_else(status.text("panel"), "there are none"));
    lines.add("sound", or_else(status.text("sound"), "nothing to say"));
    lines.add("recording", status.text("recording"));
    lines.add("packs", set_line(status));
    lines.add("left out", left_out_line(status));
    lines.add("stick", stick_line(status), false);
    lines.add("errors", errors_line(status));
}

} // namespace

std::vector<StatusLine> status_lines(const nlohmann::json& status, std::optional<double> age_s,
                                     const Surroundings* surroundings, std::time_t now) {
    const JsonFields fields(status);
    Lines lines;
    if (fields.there()) {
        add_exhibit(lines, fields, age_s, now);
    }
    if (surroundings != nullptr) {
        lines.add("starts", starts_line(fields, age_s, *surroundings));
        lines.add("watchdog", watchdog_line(surroundings->watchdog));
        lines.add("machine", notes_line(surroundings->watchdog));
        lines.add("system", image_line(surroundings->image));
        add_faults(lines, surroundings->watchdog);
        add_crashes(lines, surroundings->crashes);
    }
    if (const std::optional<double> memory_mib = fields.number("resident_mib")) {
        lines.add("memory", fmt::format("{:.0f} MiB", *memory_mib), false);
    }
    lines.add("versions", versions_line(fields, surroundings != nullptr ? surroundings->system : ""));
    return lines.take();
}

std::string status_text(const KnownExhibit& known, std::time_t now) {
    const ExhibitVerdict verdict = verdict_of(known);
    std::string text =
        verdict.sentence + (verdict.runs ? ".\n" : "; systemctl status frustumscreen says more.\n");
    if (!verdict.runs && known.status.fields.is_object()) {
        text += "What it said last:\n";
    }
    for (const StatusLine& line :
         status_lines(known.status.fields, verdict.runs ? known.status.age_s : std::nullopt,
                      &known.surroundings, now)) {
        fmt::format_to(std::back_inserter(text), "{:<14} {}\n", line.name, line.text);
    }
    return text;
}

} // namespace frustumscreen
