/// The watchdog's status, as far as others show it. programs/watchdog/watchdog_report.cpp writes it.
///
/// Threads  values; any.
#pragma once

#include "app/status/known_exhibit.h"
#include "app/status/metric.h"
#include "app/watch/step.h"
#include "firmware_host/base/json.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::status {

struct WatchdogTrouble {
    std::string cause; ///< word_of(Cause)
    std::string sentence;
    double since_s = 0.0;
};
struct WatchdogFault {
    std::string at; ///< by the wall clock
    double awake_s = 0.0;
    std::string sentence, step, done, detail;
    std::optional<bool> helped;
};
/// A missing field is empty, 0 or nothing.
struct WatchdogStatus {
    std::string mode;
    std::optional<WatchdogTrouble> trouble;
    std::optional<std::string> step; ///< name of the step that takes effect now
    std::uint64_t reboots_today = 0;
    std::vector<std::string> notes;
    std::vector<WatchdogFault> faults;
};

inline constexpr std::array all_modes{watch::Mode::Normal, watch::Mode::LastGoodSet, watch::Mode::Plain,
                                      watch::Mode::BuiltIn, watch::Mode::Safe};
static_assert(all_modes.size() == watch::mode_count);

void watchdog_fields(auto& fields, auto& status) {
    fields.word(
        "mode", status.mode, {}, all_modes, [](watch::Mode mode) { return watch::word_of(mode); },
        Metric{.name = "watchdog_mode",
               .help = "1 for what the watchdog lets the exhibit show.",
               .scale = 1.0,
               .label = "mode"});
    fields.object_or_null("trouble", status.trouble, {},
                          Metric{"watchdog_trouble", "1: it sees something wrong."},
                          [](auto& trouble, auto& value) {
                              trouble.field("cause", value.cause);
                              trouble.field("sentence", value.sentence);
                              trouble.field("since_s", value.since_s);
                          });
    fields.object_or_null("step", status.step, {}, Metric{"watchdog_step", "1: it is trying something."},
                          [](auto& step, auto& name) { step.field("name", name); });
    fields.field("reboots_today", status.reboots_today, {},
                 Metric{"watchdog_reboots", "Restarts of the machine today, by the watchdog."});
    fields.field("notes", status.notes);
    fields.objects("faults", status.faults, {}, Metric{}, [](auto& item, auto& fault) {
        item.field("at", fault.at);
        item.field("awake_s", fault.awake_s);
        item.field("sentence", fault.sentence);
        item.field("step", fault.step);
        item.field("done", fault.done);
        item.field("detail", fault.detail);
        item.field("helped", fault.helped);
    });
}

/// Reads any JSON.
[[nodiscard]] WatchdogStatus read_watchdog_status(const nlohmann::json& document);
/// The id of the watchdog's line: watchdog.unknown, watchdog.no_time, watchdog.old; its trouble, such as
/// watchdog.no_picture; or the mode of the exhibit, such as watchdog.normal.
[[nodiscard]] std::string watchdog_id(const StatusDocument& watchdog);

} // namespace frustumscreen::status
