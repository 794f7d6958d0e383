#include "app/status/watchdog_status.h"

#include "app/status/status_fields.h"

namespace frustumscreen {

WatchdogStatus read_watchdog_status(const nlohmann::json& document) {
    StatusReader fields(document);
    WatchdogStatus status;
    watchdog_fields(fields, status);
    return status;
}

} // namespace frustumscreen
