/// The wall clock at the kiosk's site: the system's time zones through libc, which also extrapolates their
/// rules beyond its tables.
///
/// A process has one time zone: the machine's, until `use_time_zone`.
///
/// Units    seconds; positive east of Greenwich.
/// Threads  `use_time_zone` before a second thread starts; everything else: any.
/// Errors   false if this machine lacks the time zone; then nothing changes.
#pragma once

#include <chrono>
#include <string>

namespace frustumscreen {

/// `name`: such as "Europe/Berlin".
[[nodiscard]] bool use_time_zone(const std::string& name);
/// Whether the machine has this time zone.
[[nodiscard]] bool has_time_zone(const std::string& name);

/// Offset of local time from UTC at `time`.
[[nodiscard]] std::chrono::seconds local_offset_at(std::chrono::sys_seconds time);

/// "2026-11-23T17:00:00Z"
[[nodiscard]] std::string utc_text(std::chrono::system_clock::time_point time);
/// "2026-11-23T18:00:00+01:00"
[[nodiscard]] std::string local_time_text(std::chrono::sys_seconds time);

} // namespace frustumscreen
