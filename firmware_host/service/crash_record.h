/// Records a crash: writes a last line to standard error, and a small file that says where it happened. The process then ends by
/// the same signal, and the service manager starts the exhibit again.
///
/// File     `crash_1` to `crash_3` in a folder (base/crash_file.h); the oldest is written over, so the last three stay. Text, a line for each fact:
///            frustumscreen-crash-1
///            unix_s N, monotonic_ms N    when; the wall clock may be wrong
///            boot ID                     of that monotonic clock (random(4))
///            signal NAME, thread NAME
///            program, system, driver     versions; `driver` is missing where none was loaded yet
///            frame MODULE+0xOFFSET       from the crash outwards; the offset is as addr2line takes it. Where a frame is not of a
///                                        file, as code that a driver compiles, MODULE is `compiled`
///            guess MODULE+0xOFFSET       where the unwinder stopped at such code: return addresses found on its stack
///            end                         the file is whole
/// Threads  installed for the whole process; whichever thread crashes writes, from its signal handler. The handler allocates
///          nothing, and is ended by SIGALRM after 3 s where the unwinder hangs.
/// Errors   none: a file that cannot be written is left out. Under a sanitizer nothing is installed: the sanitizer says more.
/// Source   signal-safety(7), proc_pid_maps(5); Itanium C++ ABI, exception handling, section 1.5 (_Unwind_Backtrace).
#pragma once

#include <filesystem>
#include <string_view>

namespace frustumscreen {

struct CrashRecordSetUp {
    std::filesystem::path folder; ///< is made if it is missing; empty: no file, only the line
    std::string_view program;     ///< version
    std::string_view system;
};
/// Once, while there is one thread.
void record_crashes(const CrashRecordSetUp& set_up);
/// The graphics driver's name and version, once it is known. The render thread.
void note_driver_for_crashes(std::string_view driver);

} // namespace frustumscreen
