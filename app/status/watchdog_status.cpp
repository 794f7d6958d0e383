#include "app/status/watchdog_status.h"

#include "app/status/status_fields.h"
#include "app/watch/cause.h"

namespace frustumscreen::status {

WatchdogStatus read_watchdog_status(const nlohmann::json& document) {
    StatusReader fields(document);
    WatchdogStatus status;
    watchdog_fields(fields, status);
    return status;
}

std::string watchdog_id(const StatusDocument& watchdog) {
    if (watchdog.fields.is_null()) {
        return "watchdog.unknown";
    }
    if (!watchdog.fresh()) {
        return watchdog.age_s ? "watchdog.old" : "watchdog.no_time";
    }
    const WatchdogStatus status = read_watchdog_status(watchdog.fields);
    if (status.trouble) {
        return watch::cause_named(status.trouble->cause) ? "watchdog." + status.trouble->cause
                                                         : "watchdog.trouble";
    }
    return watch::mode_named(status.mode) ? "watchdog." + status.mode : "watchdog.unheard_of";
}

} // namespace frustumscreen::status
