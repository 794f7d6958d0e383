#include "app/status/prometheus_text.h"

#include "app/exhibit/states.h"
#include "app/status/exhibit_verdict.h"
#include "app/status/json_fields.h"
#include "app/watch/step.h"
#include "firmware_host/service/watchdog_policy.h"

#include <fmt/format.h>

#include <iterator>
#include <string_view>

namespace frustumscreen {

namespace {

std::string quoted(std::string_view text) {
    std::string quoted = "\"";
    for (const char c : text) { // texts are one printable line
        if (c == '"' || c == '\\') {
            quoted += '\\';
        }
        quoted += c;
    }
    return quoted + "\"";
}

class Metrics {
public:
    void family(std::string_view name, const char* type, std::string_view help) {
        name_ = name;
        fmt::format_to(out(), "# HELP frustumscreen_{0} {2}\n# TYPE frustumscreen_{0} {1}\n", name, type,
                       help);
    }
    void sample(double value) { fmt::format_to(out(), "frustumscreen_{} {:.15g}\n", name_, value); }
    void sample(std::string_view label, std::string_view of, double value) {
        fmt::format_to(out(), "frustumscreen_{}{{{}={}}} {:.15g}\n", name_, label, quoted(of), value);
    }
    /// A family of one number; nothing where nobody says it.
    void gauge(std::string_view name, const std::optional<double>& value, std::string_view help) {
        single(name, "gauge", value, help);
    }
    void counter(std::string_view name, const std::optional<double>& value, std::string_view help) {
        single(name, "counter", value, help);
    }
    [[nodiscard]] std::string take() { return std::move(text_); }

private:
    [[nodiscard]] std::back_insert_iterator<std::string> out() { return std::back_inserter(text_); }
    void single(std::string_view name, const char* type, const std::optional<double>& value,
                std::string_view help) {
        if (value) {
            family(name, type, help);
            sample(*value);
        }
    }

    std::string text_;
    std::string_view name_;
};

std::optional<double> as_number(const std::optional<bool>& flag) {
    return flag ? std::optional(*flag ? 1.0 : 0.0) : std::nullopt;
}

std::optional<double> scaled(const std::optional<double>& number, double factor) {
    return number ? std::optional(*number * factor) : std::nullopt;
}

void add_what_is_shown(Metrics& metrics, const JsonFields& status) {
    metrics.family("health", "gauge", "1 for the word that says how the exhibit is.");
    for (const Health health :
         {Health::Well, Health::NoPicture, Health::FrozenCode, Health::ThreadHangs, Health::Hangs}) {
        const std::string_view word = word_of(health);
        metrics.sample("health", word, status.text("health") == word ? 1.0 : 0.0);
    }
    metrics.family("state", "gauge", "1 for the state that the exhibit is in.");
    for (const StateNote& state : state_notes) {
        metrics.sample("state", state.name, status.text("state") == state.name ? 1.0 : 0.0);
    }
    metrics.family("artifact_info", "gauge", "1; the label is the title of the artifact that is shown.");
    metrics.sample("artifact", status.text("artifact"), 1.0);
    metrics.gauge("shown_seconds", status.number("shown_for_s"), "How long this artifact has been shown.");
    metrics.gauge("estimated_error_meters", scaled(status.number("estimated_error_mm"), 1e-3),
                  "Mean distance of the drawn surface from the scan, on the prop.");
    metrics.gauge("samples_per_pixel", status.number("samples"), "Samples that are drawn for a pixel.");
    metrics.gauge("artifacts_loaded", status.at("loaded").number("artifacts"),
                  "Artifacts that can be shown at once.");
    metrics.gauge("artifacts_bytes", status.at("loaded").number("bytes"), "Memory that they take.");
    metrics.gauge("packs_left_out", static_cast<double>(status.list("left_out").size()),
                  "Packs that were asked for and cannot be shown.");
    metrics.gauge("set_number", status.at("set").number("number"),
                  "Number of the installed set that is shown.");
}

void add_pace(Metrics& metrics, const JsonFields& status) {
    metrics.gauge("uptime_seconds", status.number("uptime_s"), "Time since everything was loaded.");
    metrics.gauge("resident_memory_bytes", scaled(status.number("resident_mib"), 1024.0 * 1024.0),
                  "Memory that the exhibit takes.");
    const JsonFields times = status.at("frame_ms");
    if (times.number("p50") && times.number("p95") && times.number("p99")) {
        metrics.family("frame_time_seconds", "gauge",
                       "The time within which this share of the latest pictures was drawn.");
        metrics.sample("share", "0.5", *scaled(times.number("p50"), 1e-3));
        metrics.sample("share", "0.95", *scaled(times.number("p95"), 1e-3));
        metrics.sample("share", "0.99", *scaled(times.number("p99"), 1e-3));
    }
    metrics.counter("frames_total", status.number("frames"),
                    "Looks at the devices, one for each display time.");
    metrics.counter("frames_drawn_total", status.number("drawn"),
                    "Of these, those for which a picture was drawn.");
    metrics.counter("frames_slow_total", status.number("missed_deadlines"),
                    "Pictures that took longer than a refresh.");
    metrics.counter("display_times_skipped_total", status.number("skipped"),
                    "Display times that passed without a look.");
    metrics.counter("level_switches_total", status.number("level_switches"),
                    "Changes of level or of samples.");
}

void add_devices(Metrics& metrics, const JsonFields& status) {
    const JsonFields tracker = status.at("tracker_counts");
    metrics.counter("device_errors_total", status.number("device_errors"),
                    "Errors that devices answered with.");
    metrics.counter("tracker_connections_total", tracker.number("connections"),
                    "How often a tracker was opened.");
    metrics.counter("tracker_samples_total", tracker.number("frames"),
                    "Samples of the tracker that were taken.");
    metrics.counter("tracker_samples_lost_total", tracker.number("lost"),
                    "Samples that never came, by their numbers.");
    metrics.counter("tracker_samples_broken_total", tracker.number("broken"),
                    "How often bytes were thrown away.");
    metrics.gauge("tracker_clock_drift_ratio", scaled(tracker.number("clock_drift_ppm"), 1e-6),
                  "How much slower the tracker's clock runs.");
    if (!status.text("camera").empty()) {
        metrics.gauge("camera_frames_hertz", status.number("camera_hz"),
                      "Frames a second that come from the camera.");
    }
    metrics.gauge("drift_meters", scaled(status.number("drift_mm"), 1e-3),
                  "How far the picture lies beside where it was calibrated.");
    if (!status.text("drift").empty()) {
        metrics.gauge("drifted", as_number(status.flag("drifted")), "1: the picture is to be put right.");
    }
    metrics.counter("sound_underruns_total", status.number("sound_underruns"),
                    "How often the sound card had nothing to play.");
    metrics.gauge("prop_known", as_number(status.flag("prop_known")), "1: the prop's place is known.");
    metrics.gauge("head_known", as_number(status.flag("head_known")), "1: the visitor's head is known.");
}

void add_ends(Metrics& metrics, const Surroundings& surroundings) {
    if (!surroundings.ends_trouble.empty()) {
        return;
    }
    metrics.family("ends_total", "counter",
                   "How often the exhibit's process ended, by systemd's SERVICE_RESULT.");
    for (std::size_t k = 0; k < service_results.size(); ++k) {
        metrics.sample("result", service_results.at(k).word,
                       static_cast<double>(surroundings.ends.counts.at(k)));
    }
}

void add_watchdog(Metrics& metrics, const StatusDocument& watchdog) {
    metrics.gauge("watchdog_up", watchdog.fresh() ? 1.0 : 0.0, "1: the watchdog runs.");
    if (!watchdog.fresh()) {
        return;
    }
    const JsonFields fields(watchdog.fields);
    metrics.family("watchdog_mode", "gauge", "1 for what the watchdog lets the exhibit show.");
    for (std::size_t k = 0; k < mode_count; ++k) {
        const std::string_view mode = word_of(static_cast<Mode>(k));
        metrics.sample("mode", mode, fields.text("mode") == mode ? 1.0 : 0.0);
    }
    metrics.gauge("watchdog_trouble", fields.at("trouble").there() ? 1.0 : 0.0,
                  "1: it sees something wrong.");
    metrics.gauge("watchdog_step", fields.at("step").there() ? 1.0 : 0.0, "1: it is trying something.");
    metrics.gauge("watchdog_reboots", fields.number("reboots_today"),
                  "Restarts of the machine today, by the watchdog.");
}

void add_system(Metrics& metrics, const SystemImage& image) {
    if (!image.there()) {
        return;
    }
    metrics.family("system_info", "gauge", "1; the label is the version of the appliance's system.");
    metrics.sample("version", image.version, 1.0);
    metrics.gauge("system_notes", static_cast<double>(image.notes.size()),
                  "What was wrong when it started, such as an update that did not start.");
}

} // namespace

std::string prometheus_text(const KnownExhibit& known) {
    const ExhibitVerdict verdict = verdict_of(known);
    Metrics metrics;
    metrics.gauge("up", verdict.runs ? 1.0 : 0.0, "1: the exhibit runs.");
    metrics.gauge("well", verdict.well ? 1.0 : 0.0, "1: it runs, and nobody has a complaint.");
    metrics.gauge("status_age_seconds", known.status.age_s, "Age of the exhibit's status.");
    if (verdict.runs) {
        const JsonFields status(known.status.fields);
        const JsonFields versions = status.at("versions");
        metrics.family("build_info", "gauge", "1; the label is the exhibit's version.");
        metrics.sample("version", versions.text("program"), 1.0);
        add_what_is_shown(metrics, status);
        add_pace(metrics, status);
        add_devices(metrics, status);
    }
    add_ends(metrics, known.surroundings);
    add_watchdog(metrics, known.surroundings.watchdog);
    add_system(metrics, known.surroundings.image);
    return metrics.take();
}

} // namespace frustumscreen
