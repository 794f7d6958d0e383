/// Observations of the kiosk in one look: results, not the intentions of its parts.
///
/// Threads  values; any.
#pragma once

#include "firmware_host/base/time.h"

#include <cstdint>
#include <optional>

namespace frustumscreen::watch {

/// An older status means that the program does not run: each program writes its status once a second.
inline constexpr Nanoseconds fresh_for = std::chrono::seconds(5);

/// The exhibit's report of itself, from its status file (docs/status.md).
struct ExhibitSays {
    Nanoseconds age{0};          ///< of the report
    bool well = false;           ///< its own health
    std::uint64_t pictures = 0;  ///< shown since it began, drawn or shown again
    std::uint64_t artifacts = 0; ///< that can be shown
    bool device_hangs = false; ///< the tracker is plugged in but does not work; a reset of its port may help
    bool asleep = false;       ///< outside opening hours: the projector is dark on purpose
    [[nodiscard]] bool operator==(const ExhibitSays&) const = default;
};

struct Outcome {
    std::int32_t process = 0;           ///< the exhibit's; 0: none
    std::uint32_t failures = 0;         ///< ends of its process since the boot, except requested stops
    std::optional<ExhibitSays> exhibit; ///< none: unreadable, or of another boot
    std::optional<std::uint64_t> safe_pictures; ///< shown by the safe picture's program; none: no report
    double memory_free = 1.0;                   ///< of the machine's, 0..1
    double exhibit_memory = 0.0;                ///< of its limit, 0..1
    double disk_free = 1.0;                     ///< of the data partition, 0..1
    bool disk_writable = true;
    double disk_worn = 0.0;          ///< of its lifetime, 0..1; 0 also if the disk does not report it
    std::optional<double> hottest_c; ///< highest of the machine's sensors, degrees Celsius
    std::optional<bool> projector;   ///< a display is connected; none: no connector can tell
    bool clock_plausible = true;     ///< not earlier than the build of this program
};

} // namespace frustumscreen::watch
