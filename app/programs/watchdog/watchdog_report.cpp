#include "app/programs/watchdog/watchdog_report.h"

#include "firmware_host/base/json.h"

namespace frustumscreen::programs {

namespace {

using Json = nlohmann::ordered_json;

Json seconds_of(watch::Awake awake) {
    return std::chrono::duration_cast<std::chrono::seconds>(awake).count();
}

Json json_of(const Fault& fault) {
    return {{"at", fault.at},
            {"awake_s", seconds_of(fault.awake)},
            {"cause", fault.cause ? Json(watch::word_of(*fault.cause)) : Json(nullptr)},
            {"sentence", watch::sentence_of(fault.cause)},
            {"step", watch::word_of(fault.step)},
            {"done", watch::sentence_of(fault.step)},
            {"detail", fault.detail},
            {"helped", fault.helped ? Json(*fault.helped) : Json(nullptr)}};
}

Json trouble_of(const WatchdogReport& report) {
    const std::optional<watch::Cause>& trouble = report.seen.trouble;
    return trouble ? Json{{"cause", watch::word_of(*trouble)},
                          {"sentence", watch::sentence_of(*trouble)},
                          {"since_s", static_cast<std::int64_t>(to_seconds(report.trouble_for))}}
                   : Json(nullptr);
}

/// The current action, while it takes effect.
Json step_of(const WatchdogReport& report) {
    const watch::LadderMemory& memory = report.memory;
    const watch::Awake ago = memory.awake - memory.latest_at;
    if (!memory.latest || ago >= watch::Ladder::settling(*memory.latest)) {
        return nullptr;
    }
    return {{"name", watch::word_of(*memory.latest)},
            {"cause", memory.cause ? Json(watch::word_of(*memory.cause)) : Json(nullptr)},
            {"began_monotonic_ns", (report.now - ago).time_since_epoch().count()}};
}

} // namespace

std::string watchdog_json(const WatchdogReport& report, const std::deque<Fault>& faults) {
    const watch::LadderMemory& memory = report.memory;
    Json all = Json::array();
    for (const Fault& fault : faults) {
        all.push_back(json_of(fault));
    }
    const Json json = {{"written_at", report.at},
                       {"monotonic_ns", report.now.time_since_epoch().count()},
                       {"boot_id", report.boot_id},
                       {"mode", watch::word_of(memory.mode)},
                       {"trouble", trouble_of(report)},
                       {"lit", report.seen.lit},
                       {"step", step_of(report)},
                       {"climb", memory.climb},
                       {"next_pause_s", seconds_of(watch::Ladder::pause_after(memory.climb))},
                       {"reboots_today", report.reboots_within_day},
                       {"awake_s", seconds_of(memory.awake)},
                       {"failures", report.failures},
                       {"last_end", report.last_end},
                       {"notes", report.notes},
                       {"faults", all}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace frustumscreen::programs
