/// The reason for the end of a run's loop, and what follows from it for the program.
///
/// Threads  any; pure.
#pragma once

#include "app/show/run_loop.h"
#include "firmware_host/base/result.h"
#include "firmware_host/base/time.h"

#include <optional>

namespace frustumscreen::programs {

/// A service shows for this long why it has nothing to show. Then it ends, and systemd starts it again to look for
/// packs; it ends at once when a set of packs is installed.
inline constexpr Nanoseconds error_screen_length = std::chrono::minutes(1);

struct RunEnd {
    enum class Why : std::uint8_t {
        Done,         ///< stopped, or its time is over
        SetInstalled, ///< there is something to show: the exhibit restarts
        Failed
    };
    Why why = Why::Done;
    std::optional<Error> error; ///< if the run failed
};

/// `error_screen`: why there is nothing to show; none: there is. `set_came`: a set of packs was installed during the run.
[[nodiscard]] inline RunEnd end_of_run(const Result<show::LoopResult>& result,
                                       const std::optional<Error>& error_screen, bool set_came) {
    if (!result) {
        return {RunEnd::Why::Failed, result.error()};
    }
    if (set_came) {
        return {RunEnd::Why::SetInstalled, {}};
    }
    if (error_screen &&
        result->status.uptime_s >= to_seconds(error_screen_length)) { // a stop signal comes earlier
        return {RunEnd::Why::Failed, error_screen};
    }
    return {};
}

} // namespace frustumscreen::programs
