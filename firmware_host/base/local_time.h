/// The wall clock where the kiosk stands: the system's time zones, through libc, which also knows the rules of the years that no
/// table has.
///
/// A process has one time zone. It is the machine's until `use_time_zone`.
///
/// Units    seconds; east of Greenwich is positive.
/// Threads  `use_time_zone` before there is a second thread; the rest any.
/// Errors   there is no such time zone on this machine: nothing is changed.
#pragma once

#include <chrono>
#include <string>

namespace frustumscreen {

/// `name`: such as "Europe/Berlin".
[[nodiscard]] bool use_time_zone(const std::string& name);
/// Whether the machine has it.
[[nodiscard]] bool has_time_zone(const std::string& name);

/// How far local time is ahead of UTC then.
[[nodiscard]] std::chrono::seconds local_offset_at(std::chrono::sys_seconds time);

/// "2026-11-23T17:00:00Z"
[[nodiscard]] std::string utc_text(std::chrono::system_clock::time_point time);
/// "2026-11-23T18:00:00+01:00"
[[nodiscard]] std::string local_time_text(std::chrono::sys_seconds time);

} // namespace frustumscreen
