/// Faults of a kiosk: seeded over many days, each with the events that end it.
///
/// Assumed  the rates: we know no museum's statistics. `rate_per_year` are guesses at the upper end, so a
///          thousand days contain each kind often; the comparison is how policies perform on identical
///          faults.
/// Threads  pure; any.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace frustumscreen::simulators {

/// Seconds since the first midnight.
using MuseumTime = std::int64_t;
inline constexpr MuseumTime museum_day = 86400;

enum class FaultKind : std::uint8_t {
    Crash,        ///< the exhibit's process ends once
    Hang,         ///< it hangs; systemd's watchdog detects that
    Freeze,       ///< its picture freezes, but it still feeds systemd's watchdog
    DeviceThread, ///< a device makes it hang a few seconds after each start, until its port is reset
    TrackerHung,  ///< the tracker sends nothing until its port is reset
    TrackerDead,  ///< the tracker sends nothing until a technician replaces it
    DriverCrash,  ///< the graphics driver ends it at each start, until an update fixes it; without the GPU it
                  ///< runs
    GpuWedged,    ///< the driver gives no picture until the machine is rebooted; a plain screen works
    BadSet, ///< a set from a stick ends the exhibit seconds after its start, until a curator brings another
            ///< one
    BadSettings,   ///< the settings are damaged: it ends at once, until a technician repairs them
    Leak,          ///< its memory is full two hours after each start, until an update fixes it
    KernelHang,    ///< the machine hangs; the hardware's watchdog resets it
    MachineBroken, ///< the exhibit cannot run until a technician comes; a plain screen works
    PowerCut,
};
inline constexpr std::size_t fault_kind_count = 14;

/// Bits: the events that end a fault.
enum Remedy : unsigned {
    ByRestart = 1, ///< a new process
    ByReset = 2,   ///< reset of the port
    ByReboot = 4,
    ByLastGoodSet = 8, ///< does not end the fault, but avoids its effect in that mode
    ByBuiltIn = 16,    ///< likewise
    ByPlain = 32,      ///< likewise
};

struct FaultKindInfo {
    std::string_view name;
    double rate_per_year;
    unsigned remedies;
    double lasts_days; ///< mean time until a person mends it; 0: no person needed
};
[[nodiscard]] const FaultKindInfo& kind_of(FaultKind fault);

struct FaultEvent {
    MuseumTime at = 0;
    FaultKind fault = FaultKind::Crash;
    MuseumTime restored_at = 0; ///< by a person, at the latest
};
/// Ascending in time; `times`: factor of the usual rates.
[[nodiscard]] std::vector<FaultEvent> seeded_faults(std::uint64_t seed, int days, double times = 1.0);

} // namespace frustumscreen::simulators
