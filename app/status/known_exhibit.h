/// The exhibit's state as seen from outside, running or not: its status, its watchdog's status, and how its
/// process ended.
///
/// Time     ages are by the monotonic clock and the kernel's id of this boot. The wall clock may be wrong.
/// Threads  any; reads small files.
/// Source   os-release(5), uname(2) for the system's name.
/// Errors   none: `why` tells what could not be read. A file of another program may hold anything.
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

namespace frustumscreen::status {

inline constexpr std::string_view usual_status_file = "/run/frustumscreen/status.json";
inline constexpr std::string_view usual_watchdog_file = "/run/frustumscreen-watchdog/status.json";

/// A moment, by this machine's clocks.
struct StatusClock {
    MonotonicTime now;
    std::string boot_id; ///< random(4); empty if the kernel has none
};
/// `root`: a folder in place of /, for tests; `now` is the time in its proc/uptime, if it has this file.
[[nodiscard]] StatusClock status_clock(const std::filesystem::path& root = "/");

struct StatusDocument {
    nlohmann::json fields;       ///< an object; null: nothing is known
    std::string why;             ///< one sentence if `fields` is null
    std::optional<double> age_s; ///< none: the time of writing is missing or impossible
    bool other_boot = false;     ///< written before the machine was started
    [[nodiscard]] bool fresh() const { return age_s && *age_s <= to_seconds(watch::fresh_for); }
};
[[nodiscard]] StatusDocument parse_status(std::string_view json, const StatusClock& clock);
[[nodiscard]] StatusDocument read_status(const std::filesystem::path& file, const StatusClock& clock);

/// The machine's state, renewed every ten seconds.
struct MachineState {
    std::optional<MonotonicTime> seen;
    std::optional<double> hottest_c;
    std::optional<watch::DiskSpace> disk; ///< of the disk with all data
};
inline constexpr Nanoseconds between_looks_at_machine = std::chrono::seconds(10);

/// Facts of other programs about the exhibit's run; they never change.
struct Environment {
    StatusDocument watchdog;
    watch::ServiceEnds ends;
    std::uintmax_t ends_bytes = 0; ///< of the ends' file, which only grows
    std::string ends_trouble;      ///< why the ends' file could not be read; a missing file means no ends
    double monotonic_s = 0.0;      ///< time since the machine's start, when this was read
    MachineState machine;
    std::string system;                ///< name and version of the operating system and of the kernel
    SystemImage image;                 ///< of an appliance
    std::vector<watch::Crash> crashes; ///< the last ones, the latest first
};
using SharedEnvironment = std::shared_ptr<const Environment>;
struct StatusPlaces {
    std::filesystem::path status_file = usual_status_file; ///< the ends' file is beside it
    std::filesystem::path watchdog_file = usual_watchdog_file;
    std::filesystem::path boot_folder = usual_boot_folder;
    std::filesystem::path crash_folder = watch::usual_crash_folder;
    std::filesystem::path data_folder = "/var/lib/frustumscreen"; ///< on the disk with the packs
    std::filesystem::path root = "/";                             ///< the folder that holds sys and proc
};
/// Brings `known` up to date; files that cannot have changed are not read again.
void renew_environment(Environment& known, const StatusPlaces& places, const StatusClock& clock);
/// Name and version of the operating system and of the kernel.
[[nodiscard]] std::string system_name();

struct KnownExhibit {
    StatusDocument status;
    Environment environment;
};
[[nodiscard]] KnownExhibit read_known_exhibit(const StatusPlaces& places, const StatusClock& clock);

} // namespace frustumscreen::status
