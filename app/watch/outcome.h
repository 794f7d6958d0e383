/// What is seen of the kiosk in one look: the outcome, not what any part means to do.
///
/// Threads  values; any.
#pragma once

#include "firmware_host/base/time.h"

#include <cstdint>
#include <optional>

namespace frustumscreen {

/// A status that is older is not of a program that runs: each is written once a second.
inline constexpr Nanoseconds fresh_for = std::chrono::seconds(5);

/// What the exhibit says of itself, in its status file (docs/status.md).
struct ExhibitSays {
    Nanoseconds age{0};          ///< of what it says
    bool well = false;           ///< its own health
    std::uint64_t pictures = 0;  ///< shown since it began, drawn anew or shown again
    std::uint64_t artifacts = 0; ///< that can be shown
    bool device_hangs =
        false; ///< the tracker is plugged in and does not do what it should; a reset of its port may help
    bool asleep = false; ///< by its timetable: the projector is dark on purpose
    [[nodiscard]] bool operator==(const ExhibitSays&) const = default;
};

struct Outcome {
    std::int32_t process = 0; ///< the exhibit's; 0: there is none
    std::uint32_t failures =
        0; ///< how often its process ended by itself since the boot; told to stop does not count
    std::optional<ExhibitSays> exhibit; ///< none: it says nothing that can be read, or it is of another boot
    std::optional<std::uint64_t>
        safe_pictures;           ///< shown by the safe picture's program; none: it says nothing
    double memory_free = 1.0;    ///< of the machine's, 0..1
    double exhibit_memory = 0.0; ///< of what it may take, 0..1
    double disk_free = 1.0;      ///< of the data partition, 0..1
    bool disk_writable = true;
    double disk_worn = 0.0;          ///< of its life, 0..1; 0 also where the disk does not say
    std::optional<double> hottest_c; ///< of the machine's sensors, degrees Celsius
    std::optional<bool> projector;   ///< a display is connected; none: no connector can tell
    bool clock_plausible = true;     ///< not before this program was built
};

} // namespace frustumscreen
