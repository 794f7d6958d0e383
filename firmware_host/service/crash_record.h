/// Records a crash: a last line on standard error, and a small file with the location. The process then ends
/// by the original signal, and the service manager restarts the exhibit.
///
/// File     `crash_1` to `crash_3` in a folder (base/crash_file.h); the oldest is overwritten, so the last
///          three stay. Text, one fact per line:
///            frustumscreen-crash-1
///            unix_s N, monotonic_ms N    time of the crash; the wall clock may be wrong
///            boot ID                     boot of that monotonic clock (random(4))
///            signal NAME, thread NAME
///            program, system, driver     versions; `driver` is missing before one is loaded
///            frame MODULE+0xOFFSET       from the crash outwards; the offset is for addr2line. For code without a
///                                        file, such as code that a driver compiles, MODULE is `compiled`
///            guess MODULE+0xOFFSET       if the unwinder stopped at such code: return addresses on its stack
///            end                         the file is complete
/// Threads  installed for the whole process; the crashing thread writes, from its signal handler. The handler
///          does not allocate. If the unwinder hangs, SIGALRM ends it after 3 s.
/// Errors   none: a file that cannot be written is skipped. Under a sanitizer nothing is installed, because
///          the sanitizer reports more.
/// Source   signal-safety(7), proc_pid_maps(5); Itanium C++ ABI, exception handling, section 1.5
///          (_Unwind_Backtrace).
#pragma once

#include <filesystem>
#include <string_view>

namespace frustumscreen::service {

struct CrashRecordSetUp {
    std::filesystem::path folder; ///< made if missing; empty: only the line, no file
    std::string_view program;     ///< version
    std::string_view system;
};
/// Call it once, while the process has one thread.
void record_crashes(const CrashRecordSetUp& set_up);
/// Sets the graphics driver's name and version. Call it on the render thread.
void note_driver_for_crashes(std::string_view driver);

} // namespace frustumscreen::service
