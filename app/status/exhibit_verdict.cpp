#include "app/status/exhibit_verdict.h"

#include "app/exhibit/states.h"
#include "app/status/describe_status.h"
#include "app/status/watchdog_status.h"
#include "app/watch/step.h"
#include "firmware_host/base/words_of_time.h"
#include "firmware_host/service/watchdog_policy.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace frustumscreen::status {

namespace {

ExhibitVerdict not_running(MessageId id, std::string sentence) {
    return {.runs = false, .well = false, .sentence = std::move(sentence), .id = std::string(id.view())};
}

/// Why the status is not current; nothing if it is.
std::optional<ExhibitVerdict> why_not_running(const StatusDocument& status) {
    if (status.fields.is_null()) {
        return not_running("exhibit.unknown", fmt::format("The exhibit's status is unknown: {}", status.why));
    }
    if (status.other_boot) {
        return not_running("exhibit.other_boot",
                           "The exhibit does not run: its status is from before the machine was started");
    }
    if (!status.age_s) {
        return not_running("exhibit.no_time",
                           "The exhibit's status is unknown: its file does not say when it was written");
    }
    if (!status.fresh()) {
        return not_running(
            "exhibit.old",
            fmt::format("The exhibit does not run, or cannot say how it is: its status is {} old",
                        words_of_time(*status.age_s)));
    }
    return std::nullopt;
}

ExhibitVerdict not_well(std::string id, std::string sentence) {
    return {.runs = true, .well = false, .sentence = std::move(sentence), .id = std::move(id)};
}

ExhibitVerdict unhealthy(const std::string& word) {
    const auto* const known =
        std::find_if(all_healths.begin(), all_healths.end(),
                     [&](service::Health health) { return service::word_of(health) == word; });
    const bool is_known = known != all_healths.end();
    return not_well(is_known ? "exhibit." + word : "exhibit.unheard_of",
                    "The exhibit runs, and is not well: " + (is_known
                                                                 ? std::string(service::sentence_of(*known))
                                                                 : fmt::format("its health is '{}'", word)));
}

/// The watchdog's trouble; nothing if it has none or is unknown.
std::optional<ExhibitVerdict> watchdog_complaint(const StatusDocument& watchdog) {
    if (!watchdog.fresh()) {
        return std::nullopt;
    }
    const WatchdogStatus status = read_watchdog_status(watchdog.fields);
    if (status.trouble) {
        return not_well(watchdog_id(watchdog),
                        "The exhibit runs, and its watchdog says: " + status.trouble->sentence);
    }
    if (!status.mode.empty() && status.mode != watch::word_of(watch::Mode::Normal)) {
        return not_well(watchdog_id(watchdog),
                        fmt::format("The exhibit runs, but its watchdog {}", sentence_of_mode(status.mode)));
    }
    return std::nullopt;
}

/// The devices' faults for the staff: the first clause of each sentence, since the lines below tell what
/// to do.
struct Complaints {
    std::string id; ///< of the first one
    std::string clauses;

    void add(std::string_view of, std::string_view sentence) {
        if (clauses.empty()) {
            id = of;
        }
        clauses += fmt::format("{}{}", clauses.empty() ? "" : "; ", sentence.substr(0, sentence.find("; ")));
    }
};

/// The devices that cannot be used, and those that are impaired.
std::pair<Complaints, Complaints> complaints_of(const StatusReport& status) {
    std::pair<Complaints, Complaints> found;
    auto& [missing, impaired] = found;
    const DeviceReports& devices = status.devices;
    const std::array<std::pair<const DeviceReport&, std::string_view>, 6> all{
        {{devices.display, status.display.view()},
         {devices.screen, status.screen.view()},
         {devices.tracker, status.tracker.view()},
         {devices.camera, status.camera.view()},
         {devices.panel, status.panel.view()},
         {devices.sound, status.sound.view()}}};
    for (const auto& [device, sentence] : all) {
        if (device.ok == false) {
            missing.add(device.id, sentence);
        } else if (device.impaired) {
            impaired.add(device.id, sentence);
        }
    }
    if (status.drifted) {
        impaired.add("drift.moved", status.drift.view());
    }
    return found;
}

} // namespace

std::string_view sentence_of_mode(std::string_view word) {
    const std::optional<watch::Mode> mode = watch::mode_named(word);
    return mode ? watch::sentence_of(*mode) : word;
}

ExhibitVerdict verdict_of(const KnownExhibit& known) {
    if (std::optional<ExhibitVerdict> why = why_not_running(known.status)) {
        return std::move(*why);
    }
    const StatusReport report = read_status_report(known.status.fields);
    if (report.health != service::word_of(service::Health::Well)) {
        return unhealthy(report.health);
    }
    if (report.state == exhibit::name_of(exhibit::State::Fault)) {
        return not_well("exhibit.no_artifact", "The exhibit runs, and has no artifact that it can show");
    }
    if (std::optional<ExhibitVerdict> complaint = watchdog_complaint(known.environment.watchdog)) {
        return std::move(*complaint);
    }
    const auto [missing, impaired] = complaints_of(report);
    if (!missing.clauses.empty()) {
        return not_well(missing.id, "The exhibit runs, but: " + missing.clauses);
    }
    return impaired.clauses.empty()
               ? ExhibitVerdict{.runs = true,
                                .well = true,
                                .sentence = "The exhibit runs and is well",
                                .id = "exhibit.well"}
               : ExhibitVerdict{.runs = true,
                                .well = true,
                                .sentence =
                                    "The exhibit runs and is well, but needs attention: " + impaired.clauses,
                                .id = impaired.id};
}

} // namespace frustumscreen::status
