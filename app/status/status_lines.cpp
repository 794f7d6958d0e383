#include "app/status/status_lines.h"

#include "app/status/exhibit_lines.h"
#include "app/status/exhibit_verdict.h"
#include "app/status/line_text.h"
#include "app/status/watchdog_status.h"
#include "firmware_host/base/version.h"
#include "firmware_host/base/words_of_time.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

namespace frustumscreen::status {

namespace {

std::string starts_line(const StatusReport* status, std::optional<double> age_s, const Environment& around) {
    std::string text;
    if (status != nullptr && status->uptime_s) {
        text = fmt::format("it {} for {}; ", age_s ? "runs" : "ran",
                           words_of_time(*status->uptime_s + age_s.value_or(0.0)));
    }
    if (!around.ends_trouble.empty()) {
        return text + around.ends_trouble;
    }
    if (!around.ends.last) {
        return text + "it has not ended since the computer was started";
    }
    const watch::ServiceEnd& last = *around.ends.last;
    return fmt::format("{}it has ended {}, last {} ago: {} ({} {})", text,
                       counted(around.ends.count(), "time", "times"),
                       words_of_time(around.monotonic_s - last.monotonic_s),
                       watch::service_results.at(last.result).sentence, last.code, last.exit_status);
}

std::string watchdog_line(const StatusDocument& watchdog) {
    if (watchdog.fields.is_null()) {
        return "unknown: " + watchdog.why;
    }
    if (!watchdog.fresh()) {
        return watchdog.age_s ? fmt::format("it does not run, or hangs: its status is {} old",
                                            words_of_time(*watchdog.age_s))
                              : std::string("its status does not say when it was written");
    }
    const WatchdogStatus status = read_watchdog_status(watchdog.fields);
    std::string text(sentence_of_mode(status.mode));
    if (status.trouble) {
        text +=
            fmt::format("; {} since {}", status.trouble->sentence, words_of_time(status.trouble->since_s));
    }
    if (status.step) {
        text += fmt::format("; tries {} now", *status.step);
    }
    return fmt::format("{}; {} of the machine today", text,
                       counted(status.reboots_today, "restart", "restarts"));
}

std::string fault_line(const WatchdogFault& fault) {
    std::string text = fmt::format("{} {}", fault.at, or_else(fault.sentence, "?"));
    if (const std::string& done = fault.done.empty() ? fault.step : fault.done; !done.empty()) {
        text += ": " + done;
        if (fault.helped) {
            text += *fault.helped ? ", which helped" : ", which did not help";
        }
    }
    return fault.detail.empty() ? text : fmt::format("{} ({})", text, fault.detail);
}

/// The watchdog's observations that it does not act on.
std::string notes_line(const StatusDocument& watchdog) {
    std::vector<std::string> notes;
    if (watchdog.fresh()) {
        notes = read_watchdog_status(watchdog.fields).notes;
        notes.resize(std::min(notes.size(), max_told));
    }
    return fmt::format("{}", fmt::join(notes, "; "));
}

/// The state of the computer itself.
std::string computer_line(const Environment& around) {
    const MachineState& machine = around.machine;
    std::string text = fmt::format("on for {}", words_of_time(around.monotonic_s));
    if (machine.disk) {
        constexpr double gb = 1e9;
        text += fmt::format("; {:.1f} of {:.1f} GB of its disk are free",
                            static_cast<double>(machine.disk->free_bytes) / gb,
                            static_cast<double>(machine.disk->size_bytes) / gb);
    }
    if (machine.hottest_c) {
        text += fmt::format("; {:.0f} degrees Celsius at its hottest sensor", *machine.hottest_c);
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
    std::vector<WatchdogFault> faults = read_watchdog_status(watchdog.fields).faults;
    if (faults.empty()) {
        lines.add("last faults", "none");
    }
    // The newest comes first, in whatever order the file has them. The clock of awake_s is never set.
    std::stable_sort(faults.begin(), faults.end(),
                     [](const WatchdogFault& a, const WatchdogFault& b) { return a.awake_s > b.awake_s; });
    for (std::size_t k = 0; k < std::min(faults.size(), max_told); ++k) {
        lines.add(k == 0 ? "last faults" : "", fault_line(faults[k]));
    }
}

void add_crashes(Lines& lines, const std::vector<watch::Crash>& crashes) {
    const char* name = "last crashes";
    for (const watch::Crash& crash : crashes) {
        const std::string driver = crash.driver.empty() ? std::string() : ", " + crash.driver;
        lines.add(name, fmt::format("{:%Y-%m-%dT%H:%M:%SZ} {} (FrustumScreen {}{})",
                                    fmt::gmtime(static_cast<std::time_t>(crash.unix_s)),
                                    watch::sentence_of(crash), crash.program, driver));
        name = "";
    }
}

std::string versions_line(const StatusReport* status, const std::string& system) {
    return status != nullptr && !status->versions.program.empty()
               ? fmt::format("FrustumScreen {}, packs of format {}, {}", status->versions.program,
                             status->versions.pack_format, or_else(status->versions.system, "?"))
               : fmt::format("FrustumScreen {}, {}", project_version(), system);
}

} // namespace

std::vector<StatusLine> status_lines(const StatusReport* status, std::optional<double> age_s,
                                     const Environment* environment, std::time_t now) {
    Lines lines;
    if (status != nullptr) {
        add_exhibit(lines, *status, age_s, now);
    }
    if (environment != nullptr) {
        lines.add("starts", starts_line(status, age_s, *environment));
        lines.add("watchdog", watchdog_line(environment->watchdog));
        lines.add("computer", computer_line(*environment));
        lines.add("machine", notes_line(environment->watchdog));
        lines.add("system", image_line(environment->image));
        add_faults(lines, environment->watchdog);
        add_crashes(lines, environment->crashes);
    }
    if (status != nullptr && status->resident_mib) {
        lines.add("memory", fmt::format("{:.0f} MiB", *status->resident_mib), false);
    }
    lines.add("versions", versions_line(status, environment != nullptr ? environment->system : ""));
    return lines.take();
}

std::string status_text(const KnownExhibit& known, std::time_t now) {
    const ExhibitVerdict verdict = verdict_of(known);
    std::string text =
        verdict.sentence + (verdict.runs ? ".\n" : "; systemctl status frustumscreen says more.\n");
    const bool is_known = known.status.fields.is_object();
    if (!verdict.runs && is_known) {
        text += "Its last messages:\n";
    }
    const StatusReport report = read_status_report(known.status.fields);
    for (const StatusLine& line :
         status_lines(is_known ? &report : nullptr, verdict.runs ? known.status.age_s : std::nullopt,
                      &known.environment, now)) {
        fmt::format_to(std::back_inserter(text), "{:<14} {}\n", line.name, line.text);
    }
    return text;
}

} // namespace frustumscreen::status
