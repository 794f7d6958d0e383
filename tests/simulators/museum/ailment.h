/// What befalls a kiosk: seeded faults over many days, and what ends each of them.
///
/// Assumed  how often each comes: no museum's figures are known to us. `rate_per_year` are guesses at the upper end, so that a
///          thousand days see each kind often; what is compared is how policies fare on the same faults.
/// Threads  pure; any.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace frustumscreen {

/// Seconds since the first midnight.
using MuseumTime = std::int64_t;
inline constexpr MuseumTime museum_day = 86400;

enum class Ailment : std::uint8_t {
    Crash,        ///< the exhibit's process ends once
    Hang,         ///< it hangs; systemd's watchdog sees that
    Freeze,       ///< its picture freezes, and it feeds systemd's watchdog all the same
    DeviceThread, ///< a device makes it hang a few seconds after each start, until its port is reset
    TrackerHung,  ///< the tracker says nothing until its port is reset
    TrackerDead,  ///< it says nothing until a technician replaces it
    DriverCrash, ///< the graphics driver ends it at each start, until an update mends it; drawn plainly it runs
    GpuWedged,   ///< the driver gives no picture until the machine is started again; a plain screen works
    BadSet, ///< a set from a stick ends the exhibit seconds after its start, until a curator brings another one
    BadSettings,   ///< the settings were damaged: it ends at once, until a technician mends them
    Leak,          ///< its memory is full two hours after each start, until an update mends it
    KernelHang,    ///< the machine hangs; the hardware's watchdog resets it
    MachineBroken, ///< no exhibit is to be had until a technician comes; a plain screen works
    PowerCut,
};
inline constexpr std::size_t ailment_count = 14;

/// What ends an ailment, bits.
enum Remedy : unsigned {
    ByRestart = 1, ///< a new process
    ByReset = 2,   ///< of the port
    ByReboot = 4,
    ByLastGoodSet = 8, ///< not ended, but without effect in that mode
    ByBuiltIn = 16,    ///< as above
    ByPlain = 32,      ///< as above
};

struct AilmentKind {
    std::string_view name;
    double rate_per_year;
    unsigned remedies;
    double lasts_days; ///< until a person mends it, in the mean; 0: nobody needs to
};
[[nodiscard]] const AilmentKind& kind_of(Ailment ailment);

struct Attack {
    MuseumTime at = 0;
    Ailment ailment = Ailment::Crash;
    MuseumTime mended_at = 0; ///< by a person, at the latest
};
/// Ascending in time; `times` as many as usual.
[[nodiscard]] std::vector<Attack> seeded_attacks(std::uint64_t seed, int days, double times = 1.0);

} // namespace frustumscreen
