/// Sums up the observations of the kiosk: whether there is a fault, which one, and whether the picture is
/// alive.
///
/// Picture  is alive while the exhibit's status is fresh, well, and counts new pictures. It may be dead for
///          `picture`; after a start of the exhibit's process, for `start`.
/// Endings  a leaky bucket: each unwanted end of the process adds one, and one drains every
///          `between_endings`. From three on the exhibit keeps ending.
/// Rest     memory and device must be bad for `memory` or `device` without interruption.
/// Time     monotonic, a parameter. A late look (this program or the machine was suspended) restarts all
///          timeouts.
/// Threads  values; one caller. Allocates nothing.
#pragma once

#include "app/watch/ladder.h"
#include "app/watch/outcome.h"

#include <array>

namespace frustumscreen::watch {

struct Timeouts {
    Nanoseconds picture = std::chrono::seconds(15); ///< longer than systemd's watchdog needs
    Nanoseconds start = std::chrono::seconds(60);
    Nanoseconds safe_picture = std::chrono::seconds(30);
    Nanoseconds device = std::chrono::seconds(15); ///< the tracker's driver retries by itself first
    Nanoseconds memory = std::chrono::seconds(30);
    Nanoseconds nothing_to_show = std::chrono::seconds(45); ///< longer than the trial of a new set
    Nanoseconds between_endings = std::chrono::minutes(10);
};

class Judge {
public:
    static constexpr Nanoseconds late_look = std::chrono::seconds(5);
    static constexpr double min_memory_free = 0.04;
    static constexpr double max_exhibit_memory = 0.92;
    static constexpr double max_endings = 2.5; ///< three, less what drains between them

    Judge(const Timeouts& timeouts, MonotonicTime start);

    [[nodiscard]] Observation look(MonotonicTime now, Mode mode, const Outcome& outcome);
    /// An action is taken now: judge again from here on.
    void step_taken(MonotonicTime now);

private:
    [[nodiscard]] bool picture_lives(MonotonicTime now, const Outcome& outcome);
    void count_endings(MonotonicTime now, std::uint32_t failures);
    [[nodiscard]] std::optional<Cause> trouble_of(MonotonicTime now, const Outcome& outcome, bool lives);
    /// True if `bad` was true at every look for `duration`.
    [[nodiscard]] bool lasts(Cause cause, bool bad, MonotonicTime now, Nanoseconds duration);
    void restart(MonotonicTime now);

    Timeouts timeouts_;
    MonotonicTime looked_;
    MonotonicTime counted_;      ///< when the picture counter last moved
    MonotonicTime judged_since_; ///< latest of the start, an action, and a start of the process
    bool has_lived_ = false;     ///< since `judged_since_`
    std::int32_t process_ = 0;
    MonotonicTime process_since_; ///< when it was first seen; an older status is of the previous process
    std::uint64_t pictures_ = 0;
    double endings_ = 0.0;
    MonotonicTime drained_;
    std::optional<std::uint32_t> failures_;
    std::array<std::optional<MonotonicTime>, cause_count> bad_since_{};
};

} // namespace frustumscreen::watch
