/// What can be known of the exhibit from outside, with or without it: its status, its watchdog's, how its process ended.
///
/// Time     ages are by the monotonic clock and the kernel's name of this boot. The wall clock may be wrong.
/// Threads  any; reads small files.
/// Source   os-release(5), uname(2) for the system's name.
/// Errors   none: `why` says what could not be read. A file of another program may hold anything.
#pragma once

#include "app/status/system_image.h"
#include "app/watch/crash.h"
#include "app/watch/machine.h"
#include "app/watch/outcome.h"
#include "app/watch/service_ends.h"
#include "firmware_host/base/json.h"
#include "firmware_host/base/time.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen {

inline constexpr std::string_view usual_status_file = "/run/frustumscreen/status.json";
inline constexpr std::string_view usual_watchdog_file = "/run/frustumscreen-watchdog/status.json";

/// A moment, by this machine's clocks.
struct StatusClock {
    MonotonicTime now;
    std::string boot_id; ///< random(4); empty where the kernel does not say
};
[[nodiscard]] StatusClock status_clock();

struct StatusDocument {
    nlohmann::json fields;       ///< an object; null: nothing is known
    std::string why;             ///< then one sentence
    std::optional<double> age_s; ///< none: it does not say when it was written, or says what cannot be
    bool other_boot = false;     ///< it was written before the machine was started
    [[nodiscard]] bool fresh() const { return age_s && *age_s <= to_seconds(fresh_for); }
};
[[nodiscard]] StatusDocument parse_status(std::string_view json, const StatusClock& clock);
[[nodiscard]] StatusDocument read_status(const std::filesystem::path& file, const StatusClock& clock);

/// How the machine is, every ten seconds.
struct MachineState {
    std::optional<MonotonicTime> seen;
    std::optional<double> hottest_c;
    std::optional<DiskSpace> disk; ///< of all data
};
inline constexpr Nanoseconds between_looks_at_machine = std::chrono::seconds(10);

/// What others know of the exhibit's run; it never changes.
struct Surroundings {
    StatusDocument watchdog;
    ServiceEnds ends;
    std::uintmax_t ends_bytes = 0; ///< of their file, to which lines are only ever added
    std::string ends_trouble;      ///< why their file could not be read; one that is not there has no ends
    double monotonic_s = 0.0;      ///< when it was read: so long the machine is on
    MachineState machine;
    std::string system;         ///< name and version of the operating system and of the kernel
    SystemImage image;          ///< of an appliance
    std::vector<Crash> crashes; ///< the last ones, the latest first
};
using SharedSurroundings = std::shared_ptr<const Surroundings>;
struct StatusPlaces {
    std::filesystem::path status_file = usual_status_file; ///< the ends' file lies beside it
    std::filesystem::path watchdog_file = usual_watchdog_file;
    std::filesystem::path boot_folder = usual_boot_folder;
    std::filesystem::path crash_folder = usual_crash_folder;
    std::filesystem::path data_folder = "/var/lib/frustumscreen"; ///< on the disk with the packs
    std::filesystem::path root = "/";                             ///< below which is sys
};
/// Brings `known` up to now; what cannot have changed is not read again.
void renew_surroundings(Surroundings& known, const StatusPlaces& places, const StatusClock& clock);
/// Name and version of the operating system and of the kernel.
[[nodiscard]] std::string system_name();

struct KnownExhibit {
    StatusDocument status;
    Surroundings surroundings;
};
[[nodiscard]] KnownExhibit read_known_exhibit(const StatusPlaces& places, const StatusClock& clock);

} // namespace frustumscreen
