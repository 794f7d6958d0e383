#include "app/status/exhibit_verdict.h"

#include "app/exhibit/states.h"
#include "app/status/describe_status.h"
#include "app/status/watchdog_status.h"
#include "app/watch/step.h"
#include "firmware_host/base/words_of_time.h"
#include "firmware_host/service/watchdog_policy.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen {

namespace {

std::string health_sentence(const std::string& word) {
    const auto* const known = std::find_if(all_healths.begin(), all_healths.end(),
                                           [&](Health health) { return word_of(health) == word; });
    return known != all_healths.end() ? std::string(sentence_of(*known))
                                      : fmt::format("its health is '{}'", word);
}

/// Why nothing is known of now; empty: the status is of now.
std::string why_not_running(const StatusDocument& status) {
    if (status.fields.is_null()) {
        return fmt::format("Nothing is known of the exhibit: {}", status.why);
    }
    if (status.other_boot) {
        return "The exhibit does not run: its status is from before the machine was started";
    }
    if (!status.age_s) {
        return "Nothing is known of the exhibit: its status does not say when it was written";
    }
    if (!status.fresh()) {
        return fmt::format("The exhibit does not run, or cannot say how it is: its status is {} old",
                           words_of_time(*status.age_s));
    }
    return {};
}

/// What the watchdog complains of; empty: nothing, or nobody knows.
std::string watchdog_complaint(const StatusDocument& watchdog) {
    if (!watchdog.fresh()) {
        return {};
    }
    const WatchdogStatus status = read_watchdog_status(watchdog.fields);
    if (status.trouble) {
        return "The exhibit runs, and its watchdog says: " + status.trouble->sentence;
    }
    if (!status.mode.empty() && status.mode != word_of(Mode::Normal)) {
        return fmt::format("The exhibit runs, but its watchdog {}", sentence_of_mode(status.mode));
    }
    return {};
}

} // namespace

std::string_view sentence_of_mode(std::string_view word) {
    const std::optional<Mode> mode = mode_named(word);
    return mode ? sentence_of(*mode) : word;
}

ExhibitVerdict verdict_of(const KnownExhibit& known) {
    if (std::string why = why_not_running(known.status); !why.empty()) {
        return {false, false, std::move(why)};
    }
    const StatusReport report = read_status_report(known.status.fields);
    if (report.health != word_of(Health::Well)) {
        return {true, false, "The exhibit runs, and is not well: " + health_sentence(report.health)};
    }
    if (report.state == name_of(State::Fault)) {
        return {true, false, "The exhibit runs, and has no artifact that it can show"};
    }
    if (std::string complaint = watchdog_complaint(known.surroundings.watchdog); !complaint.empty()) {
        return {true, false, std::move(complaint)};
    }
    return {true, true, "The exhibit runs and is well"};
}

} // namespace frustumscreen
