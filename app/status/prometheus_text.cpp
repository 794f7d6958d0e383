#include "app/status/prometheus_text.h"

#include "app/status/describe_status.h"
#include "app/status/exhibit_verdict.h"
#include "app/status/status_fields.h"
#include "app/status/watchdog_status.h"

#include <fmt/format.h>

#include <iterator>
#include <string_view>
#include <utility>

namespace frustumscreen::status {

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

/// The text of the metrics. The samples of a family must be added in sequence.
class Metrics {
public:
    void add(const Metric& metric, std::string_view of, double number) {
        const auto out = std::back_inserter(text_);
        if (metric.name != family_) {
            family_ = metric.name;
            fmt::format_to(out, "# HELP frustumscreen_{0} {2}\n# TYPE frustumscreen_{0} {1}\n", family_,
                           family_.ends_with("_total") ? "counter" : "gauge", metric.help);
        }
        const std::string label =
            metric.label.empty() ? std::string() : fmt::format("{{{}={}}}", metric.label, quoted(of));
        fmt::format_to(out, "frustumscreen_{}{} {:.15g}\n", family_, label, number);
    }
    void add(const Metric& metric, double number) { add(metric, metric.of, number); }
    /// Adds the metrics of a description that `document` has.
    [[nodiscard]] StatusReader reader(const nlohmann::json& document) {
        return StatusReader(document, [this](const Metric& metric, std::string_view of, double number) {
            add(metric, of, number);
        });
    }
    [[nodiscard]] std::string take() { return std::move(text_); }

private:
    std::string text_;
    std::string_view family_;
};

void add_ends(Metrics& metrics, const Environment& environment) {
    if (!environment.ends_trouble.empty()) {
        return;
    }
    for (std::size_t k = 0; k < watch::service_results.size(); ++k) {
        metrics.add({.name = "ends_total",
                     .help = "How often the exhibit's process ended, by systemd's SERVICE_RESULT.",
                     .scale = 1.0,
                     .label = "result",
                     .of = watch::service_results.at(k).word},
                    static_cast<double>(environment.ends.counts.at(k)));
    }
}

void add_watchdog(Metrics& metrics, const StatusDocument& watchdog) {
    metrics.add({"watchdog_up", "1: the watchdog runs."}, watchdog.fresh() ? 1.0 : 0.0);
    if (watchdog.fresh()) {
        StatusReader fields = metrics.reader(watchdog.fields);
        WatchdogStatus status;
        watchdog_fields(fields, status);
    }
}

void add_machine(Metrics& metrics, const Environment& environment) {
    const MachineState& machine = environment.machine;
    metrics.add({"machine_uptime_seconds", "Time since the machine was started."}, environment.monotonic_s);
    if (machine.hottest_c) {
        metrics.add({"temperature_celsius", "Temperature of the machine's hottest sensor."},
                    *machine.hottest_c);
    }
    if (machine.disk) {
        metrics.add({"disk_free_bytes", "Free space of the disk with the packs."},
                    static_cast<double>(machine.disk->free_bytes));
        metrics.add({"disk_size_bytes", "Its size."}, static_cast<double>(machine.disk->size_bytes));
    }
}

void add_system(Metrics& metrics, const SystemImage& image) {
    if (image.there()) {
        metrics.add({.name = "system_info",
                     .help = "1; the label is the version of the appliance's system.",
                     .scale = 1.0,
                     .label = "version"},
                    image.version, 1.0);
        metrics.add({"system_notes", "Faults at its start, such as an update that did not start."},
                    static_cast<double>(image.notes.size()));
    }
}

} // namespace

std::string prometheus_text(const KnownExhibit& known) {
    const ExhibitVerdict verdict = verdict_of(known);
    Metrics metrics;
    metrics.add({"up", "1: the exhibit runs."}, verdict.runs ? 1.0 : 0.0);
    metrics.add({"well", "1: it runs without faults, and all its devices work."}, verdict.well ? 1.0 : 0.0);
    if (known.status.age_s) {
        metrics.add({"status_age_seconds", "Age of the exhibit's status."}, *known.status.age_s);
    }
    if (verdict.runs) {
        StatusReader fields = metrics.reader(known.status.fields);
        StatusReport report;
        all_status_fields(fields, report);
    }
    add_ends(metrics, known.environment);
    add_watchdog(metrics, known.environment.watchdog);
    add_machine(metrics, known.environment);
    add_system(metrics, known.environment.image);
    return metrics.take();
}

} // namespace frustumscreen::status
